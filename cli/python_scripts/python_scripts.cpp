#include "cli/python_scripts/python_scripts.hpp"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>
#include <system_error>
#include <utility>

#include "cli/report/report_assets.hpp"
#include "cli/tell.hpp"
#include "engine/files/output_error.hpp"
#include "engine/files/own_files.hpp"
#include "engine/files/run_folder.hpp"

namespace pulvis {
namespace {

namespace fs = std::filesystem;

std::string bytes_of(const fs::path& file) {
  std::ostringstream bytes;
  bytes << std::ifstream(file, std::ios::binary).rdbuf();
  return bytes.str();
}

}  // namespace

ScriptFolder::ScriptFolder(std::string_view beginning) {
  std::string name = (fs::temp_directory_path() / "pulvis-scripts-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr)
    throw OutputError(name, "make the folder", std::strerror(errno));
  path = name;
  fs::create_directory(drawn());
  for (const auto& script : report_assets_named(beginning)) {
    fs::create_directories((path / script).parent_path());
    std::ofstream file(path / script);
    file << report_asset(script);
    if (!file.flush()) throw OutputError(path / script, "write", std::strerror(errno));
  }
}

ScriptFolder::~ScriptFolder() {
  std::error_code ignored;
  fs::remove_all(path, ignored);
}

fs::path ScriptFolder::drawn() const { return path / "drawn"; }

int run_python(const std::vector<std::string>& words) {
  std::vector<char*> argv;
  for (const auto& word : words) argv.push_back(const_cast<char*>(word.c_str()));
  argv.push_back(nullptr);
  const char* python = std::getenv("PULVIS_PYTHON");  // set by the command of an installed package
  if (python == nullptr || *python == 0)
    python = access("/usr/bin/python3", X_OK) == 0 ? "/usr/bin/python3" : "python3";
  pid_t child = 0;
  if (const int error = posix_spawnp(&child, python, nullptr, nullptr, argv.data(), environ))
    throw OutputError(python, "start", std::strerror(error));
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

void put_in_place(const fs::path& drawn) {
  std::ifstream list(drawn / "list");
  std::vector<std::pair<fs::path, fs::path>> pictures;
  for (std::string line; std::getline(list, line);) {
    const auto space = line.find(' ');
    pictures.emplace_back(drawn / line.substr(0, space), line.substr(space + 1));
    require_own_or_none(pictures.back().second, role::figure);
  }
  for (const auto& [picture, place] : pictures) {
    if (place.has_parent_path()) make_results_folder(place.parent_path());
    write_own(place, role::figure, bytes_of(picture));
    tell("{}\n", place.string());
  }
}

}  // namespace pulvis
