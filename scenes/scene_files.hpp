// The files that a scene reads beside its own: traced outlines, placed particles, sieve curves, target
// profiles, height maps.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "scenes/scene.hpp"

namespace pulvis {

std::vector<std::filesystem::path> files_of(const Scene& scene);

// Goes on from `hash` with the content of those files: a scene whose tables have changed is another one.
std::uint64_t hash_with_files(const Scene& scene, std::uint64_t hash);

}  // namespace pulvis
