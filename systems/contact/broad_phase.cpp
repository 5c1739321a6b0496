#include "systems/contact/broad_phase.hpp"
#include "engine/entry.hpp"
#include "engine/portable_math.hpp"
#include "systems/contact/contact_kernel.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

namespace pulvis {

namespace {

// One outline after the other: boxes of the whole, and of its edges.
struct Boxes {
  std::vector<Box> particle;             // [slots]; undefined where is_absent is
  std::vector<std::int32_t> edge_begin;  // [slots] into edge
  std::vector<Box> edge;
};

struct Curves {
  const Bodies& bodies;
  std::span<const double> control;

  int slots() const { return static_cast<int>(bodies.slots.size()); }
  bool is_absent(int slot) const { return !bodies.is_present(slot); }
  bool is_own(int slot) const { return bodies.owns(slot); }
  int edges(int slot) const { return static_cast<int>(bodies.shape_of_slot(slot).edges.size()); }
  const double* points(int slot) const {
    return control.data() + 2 * entry(bodies.slots, slot).first_control;
  }
  const double* edge_points(int slot, int e) const {
    const Shape& shape = bodies.shape_of_slot(slot);
    return points(slot) + 2 * entry(shape.edges, e).first_control;
  }

  std::vector<Box> particle_boxes() const {
    std::vector<Box> boxes(bodies.slots.size());
    for_slots(slots(), [&](int s) {
      if (!is_absent(s))
        entry(boxes, s) = box_of(points(s), bodies.shape_of_slot(s).control_points());
    });
    return boxes;
  }
  Boxes boxes() const {
    Boxes all{particle_boxes(), {}, {}};
    std::int32_t count = 0;
    for (int s = 0; s < slots(); ++s) {
      all.edge_begin.push_back(count);
      count += is_absent(s) ? 0 : edges(s);
    }
    all.edge.resize(static_cast<std::size_t>(count));
    for_slots(slots(), [&](int s) {
      for (int e = 0; e < (is_absent(s) ? 0 : edges(s)); ++e)
        entry(all.edge, entry(all.edge_begin, s) + e) = box_of(edge_points(s, e), 4);
    });
    return all;
  }
};

using Spot = std::array<double, 2>;

// Start of the edge with these four control points.
Spot knot(const double* y) { return {(y[0] + 4 * y[2] + y[4]) / 6, (y[1] + 4 * y[3] + y[5]) / 6}; }

// Vector from the nearest point of the edge's chord to p.
Spot way_from_chord(const Spot& p, const double* control) {
  const Spot a = knot(control), b = knot(control + 2);
  const double cx = b[0] - a[0], cy = b[1] - a[1], rx = p[0] - a[0], ry = p[1] - a[1];
  const double share = std::clamp((rx * cx + ry * cy) / (cx * cx + cy * cy), 0.0, 1.0);
  return {rx - share * cx, ry - share * cy};
}

double squared_distance_to_chord(const Spot& p, const double* control) {
  const Spot d = way_from_chord(p, control);
  return d[0] * d[0] + d[1] * d[1];
}

// How far `direction` points out of the edge with these control points: 1 straight out, -1 straight in.
double outwards(const Spot& direction, const double* control) {
  const Spot a = knot(control), b = knot(control + 2);
  const double out = direction[0] * (b[1] - a[1]) - direction[1] * (b[0] - a[0]);
  const double size = (direction[0] * direction[0] + direction[1] * direction[1]) *
                      ((b[0] - a[0]) * (b[0] - a[0]) + (b[1] - a[1]) * (b[1] - a[1]));
  return size > 0 ? out / std::sqrt(size) : 0;
}

double product_of_normals(const double* one, const double* other) {
  const Spot a = knot(one), b = knot(one + 2);
  return outwards({b[1] - a[1], a[0] - b[0]}, other);
}

// Whether some part of an edge sees another one in front of it, and is seen by it. At close range, side by side
// counts too: an edge that slides along a flank approaches it from there.
bool faces(const double* own, const double* other) {
  constexpr double opposite = -0.1, close = 0.25, min_close = -0.5;
  if (product_of_normals(own, other) >= opposite) return false;
  const Spot begin = knot(own), end = knot(own + 2);
  const Spot chord{end[0] - begin[0], end[1] - begin[1]};
  const double length = chord[0] * chord[0] + chord[1] * chord[1];
  for (const double share : {0.0, 0.5, 1.0}) {
    const Spot direction =
        way_from_chord({begin[0] + share * chord[0], begin[1] + share * chord[1]}, other);
    const bool near =
        direction[0] * direction[0] + direction[1] * direction[1] < close * close * length;
    const double minimum = near ? min_close : 0;
    if (outwards(direction, other) > minimum &&
        outwards({-direction[0], -direction[1]}, own) > minimum)
      return true;
  }
  return false;
}

// The candidate search, one slot after the other.
class EdgeSearch {
 public:
  EdgeSearch(const Curves& curves, const Boxes& boxes, const PeriodicCell<TwoD>* cell,
             const BySlot<Neighbour>& neighbours, double skin)
      : curves_(curves), boxes_(boxes), cell_(cell), neighbours_(neighbours), skin_(skin) {}

  void operator()(int slot, std::vector<EdgeCandidate>& found) const {
    const std::vector<Other> others = others_of(slot);
    if (others.empty()) return;
    for (int e = 0; e < curves_.edges(slot); ++e) {
      const Spot middle = middle_of(slot, e);
      for (const Other& other : others) {
        const bool own = other.itself;
        // The image stays, the sampled edge is shifted the other way.
        const Sampled sampled{slot,
                              e,
                              moved(edge_box(slot, e), {-other.shift[0], -other.shift[1]}),
                              {middle[0] - other.shift[0], middle[1] - other.shift[1]}};
        const int ahead = own ? nearest_edge(other, sampled, Of::faced) : Shape::no_edge;
        const bool faced = ahead != Shape::no_edge;
        const int start = faced ? ahead : nearest_edge(other, sampled, Of::all);
        if (start != Shape::no_edge)
          found.push_back({slot, e, other.slot, start, faced, other.image});
      }
    }
  }

 private:
  struct Sampled {
    int slot, edge;
    Box box;
    Spot middle;
  };
  struct Other {
    int slot;
    Image image;
    Point shift;  // m, of the image
    bool itself;
    std::vector<int> edges;  // those that come near the box of the sampled particle
  };

  enum class Of { all, faced };

  const Box& edge_box(int slot, int e) const {
    return entry(boxes_.edge, entry(boxes_.edge_begin, slot) + e);
  }

  Spot middle_of(int slot, int e) const {
    const Spot begin = knot(curves_.edge_points(slot, e)),
               end = knot(curves_.edge_points(slot, e) + 2);
    return {0.5 * (begin[0] + end[0]), 0.5 * (begin[1] + end[1])};
  }

  std::vector<Other> others_of(int slot) const {
    std::vector<Other> others;
    for (const Neighbour& neighbour : neighbours_.of(slot)) {
      Other other{neighbour.slot,
                  neighbour.image,
                  shift_of(cell_, neighbour.image),
                  neighbour.is(slot),
                  {}};
      const Box own = moved(entry(boxes_.particle, slot), {-other.shift[0], -other.shift[1]});
      if (!curves_.is_own(slot) && !curves_.is_own(other.slot)) continue;  // owned by other ranks
      if (!near(own, entry(boxes_.particle, other.slot), skin_)) continue;
      for (int e = 0; e < curves_.edges(other.slot); ++e)
        if (near(own, edge_box(other.slot, e), skin_)) other.edges.push_back(e);
      if (!other.edges.empty()) others.push_back(std::move(other));
    }
    return others;
  }

  bool folded(const Sampled& own, int e) const {
    return e != own.edge && product_of_normals(curves_.edge_points(own.slot, own.edge),
                                               curves_.edge_points(own.slot, e)) < sharp_fold;
  }

  // The edge of `other` nearest to the middle of the sampled edge, among those near its box, or no_edge. In
  // self-contact the neighbours are excluded, unless the outline folds there. Measured from chords, not
  // middles: beside the end of a long edge the middle of a short one around the corner may be nearer, and
  // from there no search leads back past the corner.
  int nearest_edge(const Other& other, const Sampled& own, Of of) const {
    if (!near(own.box, entry(boxes_.particle, other.slot), skin_)) return Shape::no_edge;
    int nearest = Shape::no_edge;
    double minimum = std::numeric_limits<double>::max();
    for (const int e : other.edges) {
      if (!near(own.box, edge_box(other.slot, e), skin_)) continue;
      if (other.itself && (of == Of::all || !folded(own, e)) &&
          edges_between(own.edge, e, curves_.edges(own.slot)) < min_fold)
        continue;
      const double distance =
          squared_distance_to_chord(own.middle, curves_.edge_points(other.slot, e));
      if (distance >= minimum) continue;
      if (of == Of::faced &&
          !faces(curves_.edge_points(own.slot, own.edge), curves_.edge_points(other.slot, e)))
        continue;
      minimum = distance;
      nearest = e;
    }
    const auto& edges = curves_.bodies.shape_of_slot(other.slot).edges;
    const bool corners = entry(edges, 0).previous == Shape::no_edge;
    return nearest != Shape::no_edge && corners && !other.itself ? nearest_of_all(other.slot, own)
                                                                 : nearest;
  }

  // A nearby box may belong to an edge around a corner from the nearest one, whose own box is not near: seen from its
  // back the sampled edge would be deep inside.
  int nearest_of_all(int slot, const Sampled& own) const {
    int nearest = Shape::no_edge;
    double minimum = std::numeric_limits<double>::max();
    for (int e = 0; e < curves_.edges(slot); ++e) {
      const double distance = squared_distance_to_chord(own.middle, curves_.edge_points(slot, e));
      if (distance >= minimum) continue;
      minimum = distance;
      nearest = e;
    }
    return nearest;
  }

  const Curves& curves_;
  const Boxes& boxes_;
  const PeriodicCell<TwoD>* cell_;
  const BySlot<Neighbour>& neighbours_;
  double skin_;
};

}  // namespace

int edges_between(int a, int b, int edges) {
  const int apart = std::abs(a - b);
  return std::min(apart, edges - apart);
}

BySlot<Neighbour> particle_neighbours(const Bodies& bodies, std::span<const double> control,
                                      const PeriodicCell<TwoD>* cell, double distance) {
  return near_particles(Curves{bodies, control}.particle_boxes(), bodies.present_slots, cell,
                        distance);
}

BySlot<EdgeCandidate> edge_candidates(const Bodies& bodies, std::span<const double> control,
                                      const PeriodicCell<TwoD>* cell,
                                      const BySlot<Neighbour>& neighbours, double skin) {
  const Curves curves{bodies, control};
  const Boxes boxes = curves.boxes();
  return list_by_slot<EdgeCandidate>(curves.slots(),
                                     EdgeSearch(curves, boxes, cell, neighbours, skin));
}

int start_of_point(const Bodies& bodies, std::span<const double> control,
                   const PeriodicCell<TwoD>* cell, const EdgeCandidate& candidate, int point) {
  const Curves curves{bodies, control};
  const auto& edges = bodies.shape_of_slot(candidate.other).edges;
  const int count = static_cast<int>(edges.size());
  const Shape::Edge& start = entry(edges, candidate.start);
  if (start.next != Shape::no_edge && start.previous != Shape::no_edge) return candidate.start;
  const double* own = curves.edge_points(candidate.slot, candidate.edge);
  const auto n = kernels::basis(entry(kernels::edge_u, point));
  const Point shift = shift_of(cell, candidate.image);
  Spot at{-shift[0], -shift[1]};
  for (int a = 0; a < 4; ++a)
    for (int k = 0; k < 2; ++k) at[static_cast<std::size_t>(k)] += entry(n, a) * own[2 * a + k];
  const auto distance = [&](int e) {
    return squared_distance_to_chord(at, curves.edge_points(candidate.other, e));
  };
  int nearest = candidate.start;
  const auto look_at = [&](int neighbour) {
    if (distance(neighbour) < distance(nearest)) nearest = neighbour;
  };
  if (start.next == Shape::no_edge) look_at((candidate.start + 1) % count);
  if (start.previous == Shape::no_edge) look_at((candidate.start + count - 1) % count);
  return nearest;
}

}  // namespace pulvis
