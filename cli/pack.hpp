// pulvis pack: the particles of a scene as a table.
#pragma once

#include <filesystem>

#include "cli/exit_code.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

ExitCode pack_scene(const Scene& scene, const std::filesystem::path& file);

}  // namespace pulvis
