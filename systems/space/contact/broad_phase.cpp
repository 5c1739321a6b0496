#include "systems/space/contact/broad_phase.hpp"

#include <cmath>
#include <limits>

namespace pulvis::space {
namespace {

// Particles by cell of a uniform grid; a cell is as large as the largest particle, so that neighbours are in
// adjacent cells.
class ParticleGrid {
 public:
  ParticleGrid(const std::vector<Box>& boxes, const std::vector<int>& slots, double distance) {
    Box all = entry(boxes, slots.front());
    for (const int s : slots) {
      const Box& b = entry(boxes, s);
      all = joined(all, b);
      for (std::size_t k = 0; k < 3; ++k) size_ = std::max(size_, b.high[k] - b.low[k] + distance);
    }
    low_ = all.low;
    // A particle that flew away must not inflate the grid; far cells are clamped to the last one.
    for (std::size_t k = 0; k < 3; ++k)
      count_[k] = static_cast<int>(std::clamp((all.high[k] - all.low[k]) / size_ + 1, 1.0, 256.0));
    begin_.assign(static_cast<std::size_t>(count_[0] * count_[1] * count_[2]) + 1, 0);
    for (const int s : slots) entry(begin_, cell(entry(boxes, s)) + 1) += 1;
    std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
    members_.resize(slots.size());
    std::vector<std::int32_t> next(begin_.begin(), begin_.end() - 1);
    for (const int s : slots) entry(members_, entry(next, cell(entry(boxes, s)))++) = s;
  }

  template <class Visit>
  void around(const Box& box, const Visit& visit) const {
    std::array<int, 3> low, high;
    for (std::size_t k = 0; k < 3; ++k) {
      const int at = index(box, k);
      low[k] = std::max(at - 1, 0);
      high[k] = std::min(at + 1, count_[k] - 1);
    }
    for (int z = low[2]; z <= high[2]; ++z)
      for (int y = low[1]; y <= high[1]; ++y)
        for (int x = low[0]; x <= high[0]; ++x) {
          const int c = (z * count_[1] + y) * count_[0] + x;
          for (int m = entry(begin_, c); m < entry(begin_, c + 1); ++m) visit(entry(members_, m));
        }
  }

 private:
  int index(const Box& box, std::size_t k) const {
    return static_cast<int>(std::clamp((box.middle()[k] - low_[k]) / size_, 0.0, count_[k] - 1.0));
  }
  int cell(const Box& box) const {
    return (index(box, 2) * count_[1] + index(box, 1)) * count_[0] + index(box, 0);
  }

  double size_ = 0;
  std::array<double, 3> low_{};
  std::array<int, 3> count_{1, 1, 1};
  std::vector<std::int32_t> begin_, members_;
};

double squared_distance(const Point& a, const Point& b) {
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
  return sum;
}

// Another particle, with those of its faces that are near a particle's box.
struct NearParticle {
  std::int32_t slot;
  std::vector<std::int32_t> faces;
};

// Finds the candidates of one slot after another.
struct FaceSearch {
  const ShapedBodies<ThreeD>& bodies;
  const SurfaceBoxes& boxes;
  const BySlot<std::int32_t>& neighbours;
  double distance;

  void operator()(int slot, std::vector<FaceCandidate>& found) const {
    const std::vector<NearParticle> others = others_of(slot);
    if (others.empty()) return;
    const std::span<const Box> own = boxes.face.of(slot);
    for (const NearParticle& other : others)
      for (std::int32_t f = 0; f < static_cast<std::int32_t>(own.size()); ++f) {
        const std::int32_t start = nearest_face(entry(own, f), other);
        if (start >= 0) found.push_back({slot, f, other.slot, start});
      }
  }

 private:
  std::vector<NearParticle> others_of(int slot) const {
    std::vector<NearParticle> others;
    const Box& own = entry(boxes.particle, slot);
    for (const std::int32_t neighbour : neighbours.of(slot)) {
      if (!bodies.bodies->owns(slot) && !bodies.bodies->owns(neighbour)) continue;
      if (!near(own, entry(boxes.particle, neighbour), distance)) continue;
      NearParticle other{neighbour, {}};
      const std::span<const Box> faces = boxes.face.of(neighbour);
      for (std::int32_t f = 0; f < static_cast<std::int32_t>(faces.size()); ++f)
        if (near(own, entry(faces, f), distance)) other.faces.push_back(f);
      if (!other.faces.empty()) others.push_back(std::move(other));
    }
    return others;
  }
  // Among those near the box, or -1.
  std::int32_t nearest_face(const Box& own, const NearParticle& other) const {
    std::int32_t nearest = -1;
    if (!near(own, entry(boxes.particle, other.slot), distance)) return nearest;
    double minimum = std::numeric_limits<double>::max();
    const std::span<const Box> faces = boxes.face.of(other.slot);
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

BySlot<std::int32_t> particle_neighbours(const ShapedBodies<ThreeD>& bodies,
                                         const SurfaceBoxes& boxes, double distance) {
  const std::vector<int>& slots = bodies.bodies->present_slots;
  if (slots.empty()) return BySlot<std::int32_t>::none(bodies.slots());
  const ParticleGrid grid(boxes.particle, slots, distance);
  return list_by_slot<std::int32_t>(
      bodies.slots(), [&](int slot, std::vector<std::int32_t>& found) {
        if (bodies.is_absent(slot)) return;
        const auto first = static_cast<std::ptrdiff_t>(found.size());
        const Box& own = entry(boxes.particle, slot);
        grid.around(own, [&](int other) {
          if (other != slot && near(own, entry(boxes.particle, other), distance))
            found.push_back(other);
        });
        std::sort(found.begin() + first, found.end());
      });
}

BySlot<FaceCandidate> face_candidates(const ShapedBodies<ThreeD>& bodies, const SurfaceBoxes& boxes,
                                      const BySlot<std::int32_t>& neighbours, double distance) {
  return list_by_slot<FaceCandidate>(bodies.slots(),
                                     FaceSearch{bodies, boxes, neighbours, distance});
}

}  // namespace pulvis::space
