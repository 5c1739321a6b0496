// Finds which faces of which particles are near each other: pure geometry, no columns. Exact for the boxes
// of the Bezier points, which contain their face.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "systems/contact/neighbours.hpp"
#include "systems/space/contact/box.hpp"

namespace pulvis::space {

using Neighbour = NeighbourIn<ThreeD>;

// A face of the particle in `slot` near another particle, whose face `start` is closest to it.
struct FaceCandidate {
  std::int32_t slot, face;
  Neighbour other;
  std::int32_t start;
};

// Bounding boxes of whole particles, and of their faces, by slot.
struct SurfaceBoxes {
  std::vector<Box> particle;  // [slots]; undefined for empty slots
  BySlot<Box> face;
};
SurfaceBoxes surface_boxes(const ShapedBodies<ThreeD>& bodies, std::span<const double> positions);

// All candidates within `distance`, sorted by (slot, other, image, face). `neighbours`: found with at least `distance`;
// `cell`: null if nothing is periodic.
BySlot<FaceCandidate> face_candidates(const ShapedBodies<ThreeD>& bodies, const SurfaceBoxes& boxes,
                                      const PeriodicCell<ThreeD>* cell,
                                      const BySlot<Neighbour>& neighbours, double distance);

}  // namespace pulvis::space
