// Whether the particles have room where they are.
#pragma once

#include <cstddef>
#include <vector>

#include "scenes/spec/space_scene.hpp"

namespace pulvis::space {

// Throws SceneError when particles overlap each other or a tool, naming both, the depth, and the place of the scene that
// put the particle there. Returns how many pairs of particles were near enough to be looked at. Particles count as their
// convex hulls; tools from STL files are left to the first step.
std::size_t check_overlaps(const Scene& scene, const std::vector<BodySpec>& bodies);

}  // namespace pulvis::space
