// Particles that overlap each other, or reach into tools.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "scenes/spec/space_scene.hpp"

namespace pulvis::space {

// Throws SceneError: each overlap with both particles, or particle and tool, and its depth; twenty at most. Particles are
// looked at as the convex bodies that packings are made of (rigid_shape.hpp); against punches and STL tools by places on their
// true surface. Returns the number of pairs whose bounding balls meet.
std::size_t check_overlaps(const Scene& scene, const std::vector<BodySpec>& bodies);

// One line where particles that touch by their true shapes overlap by the smooth surfaces of their meshes, which contacts see.
std::vector<std::string> contact_overlap_warnings(const Scene& scene,
                                                  const std::vector<BodySpec>& bodies);

}  // namespace pulvis::space
