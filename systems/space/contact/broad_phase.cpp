#include "systems/space/contact/broad_phase.hpp"

#include <cmath>
#include <limits>

namespace pulvis::space {
namespace {

double squared_distance(const Point& a, const Point& b) {
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
  return sum;
}

// Another particle, or one of its periodic images, with those of its faces that are near a particle's box.
struct NearParticle {
  Neighbour who;
  Point shift;  // m, of the image
  std::vector<std::int32_t> faces;
};

// Instead of an image what comes near it is moved, the other way.
Box as_seen_from(const Point& shift, const Box& box) {
  return moved(box, {-shift[0], -shift[1], -shift[2]});
}

// Finds the candidates of one slot after another.
struct FaceSearch {
  const ShapedBodies<ThreeD>& bodies;
  const SurfaceBoxes& boxes;
  const PeriodicCell<ThreeD>* cell;
  const BySlot<Neighbour>& neighbours;
  double distance;

  void operator()(int slot, std::vector<FaceCandidate>& found) const {
    const std::vector<NearParticle> others = others_of(slot);
    if (others.empty()) return;
    const std::span<const Box> own = boxes.face.of(slot);
    for (const NearParticle& other : others)
      for (std::int32_t f = 0; f < static_cast<std::int32_t>(own.size()); ++f) {
        const std::int32_t start = nearest_face(as_seen_from(other.shift, entry(own, f)), other);
        if (start >= 0) found.push_back({slot, f, other.who, start});
      }
  }

 private:
  std::vector<NearParticle> others_of(int slot) const {
    std::vector<NearParticle> others;
    for (const Neighbour& neighbour : neighbours.of(slot)) {
      if (!bodies.bodies->owns(slot) && !bodies.bodies->owns(neighbour.slot)) continue;
      NearParticle other{neighbour, shift_of(cell, neighbour.image), {}};
      const Box own = as_seen_from(other.shift, entry(boxes.particle, slot));
      if (!near(own, entry(boxes.particle, neighbour.slot), distance)) continue;
      const std::span<const Box> faces = boxes.face.of(neighbour.slot);
      for (std::int32_t f = 0; f < static_cast<std::int32_t>(faces.size()); ++f)
        if (near(own, entry(faces, f), distance)) other.faces.push_back(f);
      if (!other.faces.empty()) others.push_back(std::move(other));
    }
    return others;
  }
  // Among those near the box, or -1.
  std::int32_t nearest_face(const Box& own, const NearParticle& other) const {
    std::int32_t nearest = -1;
    if (!near(own, entry(boxes.particle, other.who.slot), distance)) return nearest;
    double minimum = std::numeric_limits<double>::max();
    const std::span<const Box> faces = boxes.face.of(other.who.slot);
    for (const std::int32_t f : other.faces) {
      const Box& its = entry(faces, f);
      if (!near(own, its, distance)) continue;
      const double square = squared_distance(own.middle(), its.middle());
      if (square >= minimum) continue;
      minimum = square;
      nearest = f;
    }
    return nearest;
  }
};

}  // namespace

SurfaceBoxes surface_boxes(const ShapedBodies<ThreeD>& bodies, std::span<const double> positions) {
  SurfaceBoxes boxes{std::vector<Box>(static_cast<std::size_t>(bodies.slots())),
                     list_by_slot<Box>(bodies.slots(), [&](int slot, std::vector<Box>& found) {
                       if (bodies.is_absent(slot)) return;
                       const auto faces = static_cast<int>(bodies.shape_of(slot).faces.size());
                       for (int f = 0; f < faces; ++f)
                         found.push_back(face_box(bodies.patch(positions, slot, f)));
                     })};
  for (int slot = 0; slot < bodies.slots(); ++slot) {
    const std::span<const Box> own = boxes.face.of(slot);
    if (own.empty()) continue;
    Box all = own.front();
    for (const Box& box : own) all = joined(all, box);
    entry(boxes.particle, slot) = all;
  }
  return boxes;
}

BySlot<FaceCandidate> face_candidates(const ShapedBodies<ThreeD>& bodies, const SurfaceBoxes& boxes,
                                      const PeriodicCell<ThreeD>* cell,
                                      const BySlot<Neighbour>& neighbours, double distance) {
  return list_by_slot<FaceCandidate>(bodies.slots(),
                                     FaceSearch{bodies, boxes, cell, neighbours, distance});
}

}  // namespace pulvis::space
