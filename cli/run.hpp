// pulvis run: a scene from its file to its results folder.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cli/exit_code.hpp"

namespace pulvis {

struct RunOptions {
  std::filesystem::path scene;
  std::filesystem::path folder;  // empty: runs/<name of the scene>
  int threads = 0;               // 0: all processors
  bool overwrite = false;
  std::vector<std::string> overrides;  // key.path=value
};

ExitCode run_scene(const RunOptions& options);

}  // namespace pulvis
