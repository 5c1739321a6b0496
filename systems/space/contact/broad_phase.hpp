// Finds which faces of which particles are near each other: pure geometry, no columns. Exact for the boxes
// of the Bezier points, which contain their face.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "systems/contact/by_slot.hpp"
#include "systems/space/contact/box.hpp"

namespace pulvis::space {

// A face of the particle in `slot` near the particle in `other`, whose face `start` is closest to it.
struct FaceCandidate {
  std::int32_t slot, face, other, start;
};

// Bounding boxes of whole particles, and of their faces, by slot.
struct SurfaceBoxes {
  std::vector<Box> particle;  // [slots]; undefined for empty slots
  BySlot<Box> face;
};
SurfaceBoxes surface_boxes(const ShapedBodies<ThreeD>& bodies, std::span<const double> positions);

// For every slot, the other particles within `distance` (between boxes), ascending.
BySlot<std::int32_t> particle_neighbours(const ShapedBodies<ThreeD>& bodies,
                                         const SurfaceBoxes& boxes, double distance);

// All candidates within `distance`, sorted by (slot, other, face). `neighbours`: found with at least `distance`.
BySlot<FaceCandidate> face_candidates(const ShapedBodies<ThreeD>& bodies, const SurfaceBoxes& boxes,
                                      const BySlot<std::int32_t>& neighbours, double distance);

}  // namespace pulvis::space
