// The scene files that Pulvis ships; beside them lie studies, parts of scenes, settings of reductions, and tables.
#pragma once

#include <algorithm>
#include <filesystem>
#include <vector>
#include "tests/helpers/paths.hpp"

namespace pulvis {

inline std::vector<std::filesystem::path> shipped_scenes() {
  const std::filesystem::path root = std::filesystem::path(paths::source_dir()) / "scenes";
  std::vector<std::filesystem::path> scenes;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root)) {
    const std::filesystem::path folder = entry.path().parent_path();
    const bool other = folder == root / "studies" || folder == root / "probes" ||
                       folder == root / "lab" || folder == root / "parts" ||
                       folder == root / "materials";
    if (entry.path().extension() == ".toml" && !other) scenes.push_back(entry.path());
  }
  std::ranges::sort(scenes);
  return scenes;
}

}  // namespace pulvis
