// Whether the particles have room where they are.
#pragma once

#include <cstddef>
#include <vector>

#include "scenes/spec/scene.hpp"

namespace pulvis {

// Throws SceneError when particles overlap each other or a tool, naming both, the depth, and the
// place of the scene that put the particle there. Returns how many pairs of particles were near enough to be looked at.
std::size_t check_overlaps(const Scene& scene, const std::vector<BodySpec>& bodies);

}  // namespace pulvis
