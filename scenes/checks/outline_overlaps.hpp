// Overlaps of outlines, in two dimensions.
#pragma once

#include "scenes/packing/overlap.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

// Exact between rounded boxes; other outlines count as polygons (scenes/packing/outlines/outline_depth.hpp).
Overlaps outline_overlaps(const Scene& scene, const std::vector<BodySpec>& bodies);

}  // namespace pulvis
