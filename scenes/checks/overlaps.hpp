// Checks that the particles do not overlap as placed.
#pragma once

#include <cstddef>
#include <vector>

#include "scenes/spec/scene.hpp"

namespace pulvis {

// Throws SceneError when particles are too far from the origin for their size (far_away.hpp), or overlap each other or a
// tool, naming both, the depth, and the line of the scene that placed the particle; at most twenty. Returns how many pairs
// of particles were close enough to be checked.
std::size_t check_overlaps(const Scene& scene, const std::vector<BodySpec>& bodies);

}  // namespace pulvis
