#include "cli/figure.hpp"

#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>

#include "cli/report/report_assets.hpp"
#include "cli/tell.hpp"
#include "engine/files/own_files.hpp"
#include "engine/files/run_folder.hpp"

namespace pulvis {
namespace {

namespace fs = std::filesystem;

constexpr const char* drawn_folder =
    "drawn";  // folder of the figures, until they are put in their places

// A folder for the scripts, gone when the figures are drawn.
class ScriptFolder {
 public:
  ScriptFolder() {
    std::string name = (fs::temp_directory_path() / "pulvis-figures-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr)
      throw OutputError(name, "make the folder", std::strerror(errno));
    path = name;
    fs::create_directory(path / drawn_folder);
    for (const auto& script : report_assets_named("figure")) {
      std::ofstream file(path / script);
      file << report_asset(script);
      if (!file.flush()) throw OutputError(path / script, "write", std::strerror(errno));
    }
  }
  ScriptFolder(const ScriptFolder&) = delete;
  ScriptFolder& operator=(const ScriptFolder&) = delete;
  ~ScriptFolder() {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }

  fs::path path;
};

std::vector<std::string> arguments(const fs::path& scripts, const FigureOptions& options) {
  std::vector<std::string> all{"python3",
                               "-B",
                               (scripts / "figures.py").string(),
                               "--format=" + options.format,
                               "--level=" + options.level,
                               "--draw-into=" + (scripts / drawn_folder).string()};
  if (!options.output.empty()) all.push_back("--output=" + options.output.string());
  if (!options.field.empty()) all.push_back("--field=" + options.field);
  if (options.frame) all.push_back(fmt::format("--frame={}", *options.frame));
  for (const auto& series : options.series) all.push_back("--series=" + series);
  if (!options.against.empty()) all.push_back("--against=" + options.against);
  all.insert(all.end(), {"--", options.folder.string()});  // its name may begin with a '-'
  return all;
}

// Debian's own python has the modules of Debian's packages; elsewhere the first on the path.
int run_python(const std::vector<std::string>& words) {
  std::vector<char*> argv;
  for (const auto& word : words) argv.push_back(const_cast<char*>(word.c_str()));
  argv.push_back(nullptr);
  const char* python = access("/usr/bin/python3", X_OK) == 0 ? "/usr/bin/python3" : "python3";
  pid_t child = 0;
  if (const int error = posix_spawnp(&child, python, nullptr, nullptr, argv.data(), environ))
    throw OutputError(python, "start", std::strerror(error));
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

std::string bytes_of(const fs::path& file) {
  std::ostringstream bytes;
  bytes << std::ifstream(file, std::ios::binary).rdbuf();
  return bytes.str();
}

// Each line of the list: a file's name there, and where it belongs. No other than an own file is replaced.
void put_in_place(const fs::path& folder) {
  std::ifstream list(folder / "list");
  std::vector<std::pair<fs::path, fs::path>> figures;
  for (std::string line; std::getline(list, line);) {
    const auto space = line.find(' ');
    figures.emplace_back(folder / line.substr(0, space), line.substr(space + 1));
    require_own_or_none(figures.back().second, role::figure);
  }
  for (const auto& [figure, place] : figures) {
    if (place.has_parent_path()) make_results_folder(place.parent_path());
    write_own(place, role::figure, bytes_of(figure));
    tell("{}\n", place.string());
  }
}

}  // namespace

ExitCode draw_figures(const FigureOptions& options) {
  const ScriptFolder scripts;
  const int code = run_python(arguments(scripts.path, options));
  put_in_place(scripts.path / drawn_folder);
  switch (code) {
    case 0:
      return ExitCode::done;
    case 2:
      return ExitCode::usage;
    default:
      return ExitCode::machine;
  }
}

}  // namespace pulvis
