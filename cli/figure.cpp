#include "cli/figure.hpp"

#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>

#include "cli/report_assets.hpp"
#include "engine/output_error.hpp"

namespace pulvis {
namespace {

namespace fs = std::filesystem;

// A folder for the scripts, gone when the figures are drawn.
class ScriptFolder {
 public:
  ScriptFolder() {
    std::string name = (fs::temp_directory_path() / "pulvis-figures-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr)
      throw OutputError(name, "make the folder", std::strerror(errno));
    path = name;
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

std::vector<std::string> arguments(const fs::path& script, const FigureOptions& options) {
  std::vector<std::string> all{"python3", "-B", script.string(), "--format=" + options.format};
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

}  // namespace

ExitCode draw_figures(const FigureOptions& options) {
  const ScriptFolder scripts;
  switch (run_python(arguments(scripts.path / "figures.py", options))) {
    case 0:
      return ExitCode::done;
    case 2:
      return ExitCode::usage;
    default:
      return ExitCode::machine;
  }
}

}  // namespace pulvis
