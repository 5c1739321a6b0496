// scene.toml in a run's folder, and copies of the files it refers to.
#pragma once

#include <filesystem>

#include "scenes/read.hpp"

namespace pulvis {

void save_scene(const std::filesystem::path& folder, const LoadedScene& loaded);

// OutputError if scene.toml was removed: without it, nobody knows what was run, and nothing can be resumed.
void require_saved_scene(const std::filesystem::path& folder);

// The scene as a resumed run reads it: it is compared with the copies in other scenes, whatever has happened to
// the originals by the time it ends.
LoadedScene as_saved(const std::filesystem::path& folder, LoadedScene loaded);

// Into `folder`. An existing copy stays; a different file of the same name is never replaced:
// RunFolderTaken.
void save_inputs(const std::filesystem::path& folder, const std::vector<InputFile>& inputs);

}  // namespace pulvis
