// Particles that overlap each other or penetrate tools.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "scenes/spec/scene.hpp"

namespace pulvis::space {

// Throws SceneError: each overlap with both particles, or particle and tool, and its depth; at most twenty. Particles are
// treated as the convex bodies used for packings (rigid_shape.hpp); against punches and STL tools, as points on their
// true surface. Returns the number of pairs whose bounding spheres intersect.
std::size_t check_overlaps(const Scene& scene, const std::vector<BodySpec>& bodies);

// One line if particles whose true shapes touch overlap with the smooth surfaces of their meshes, which contacts use.
std::vector<std::string> contact_overlap_warnings(const Scene& scene,
                                                  const std::vector<BodySpec>& bodies);

}  // namespace pulvis::space
