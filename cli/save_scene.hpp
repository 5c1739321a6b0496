// scene.toml of a run's folder, and the copies of the files that it names.
#pragma once

#include <filesystem>

#include "scenes/read.hpp"

namespace pulvis {

void save_scene(const std::filesystem::path& folder, const LoadedScene& loaded);

// OutputError where somebody has taken scene.toml away: without it nobody knows what was run, and nothing goes on.
void require_saved_scene(const std::filesystem::path& folder);

// The scene as a resumed run has it: it is compared with the copies of other scenes, whatever has become of
// the originals when it ends.
LoadedScene as_saved(const std::filesystem::path& folder, LoadedScene loaded);

// Into `folder`. A copy that is there already stays; another file of its name is never replaced:
// RunFolderTaken.
void save_inputs(const std::filesystem::path& folder, const std::vector<InputFile>& inputs);

}  // namespace pulvis
