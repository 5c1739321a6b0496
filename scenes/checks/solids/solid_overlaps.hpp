// Overlaps of solids, in three dimensions.
#pragma once

#include <string>
#include <vector>

#include "scenes/packing/overlap.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis::space {

// Particles are treated as the convex bodies used for packings (scenes/packing/solids/rigid_shape.hpp); against punches and
// STL tools, as points on their true surface. Pairs: those whose bounding spheres intersect.
Overlaps solid_overlaps(const Scene& scene, const std::vector<BodySpec>& bodies);

// One line if particles whose true shapes touch overlap with the smooth surfaces of their meshes, which contacts use.
std::vector<std::string> contact_overlap_warnings(const Scene& scene,
                                                  const std::vector<BodySpec>& bodies);

}  // namespace pulvis::space
