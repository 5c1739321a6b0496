// Which faces of which particles are near which others: pure geometry, no columns. Exact with respect to the boxes of
// Bezier points, which contain their face.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "systems/contact/by_slot.hpp"
#include "systems/space/contact/box.hpp"

namespace pulvis::space {

// A face of the particle in `slot` near the particle in `other`, whose face `start` is the nearest to it.
struct FaceCandidate {
  std::int32_t slot, face, other, start;
};

// Boxes of whole particles, and of their faces, by slot.
struct SurfaceBoxes {
  std::vector<Box> particle;  // [slots]; undefined where a slot is empty
  BySlot<Box> face;
};
SurfaceBoxes surface_boxes(const ShapedBodies& bodies, std::span<const double> positions);

// Of every slot the other particles within `distance` (of boxes), ascending.
BySlot<std::int32_t> particle_neighbours(const ShapedBodies& bodies, const SurfaceBoxes& boxes,
                                         double distance);

// All candidates within `skin`, sorted by (slot, other, face). `neighbours`: within `skin` or more.
BySlot<FaceCandidate> face_candidates(const ShapedBodies& bodies, const SurfaceBoxes& boxes,
                                      const BySlot<std::int32_t>& neighbours, double skin);

}  // namespace pulvis::space
