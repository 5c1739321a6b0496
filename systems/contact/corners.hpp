// Corners of the other outline: which of the two edges that meet there answers for a point that is behind one of them.
//
// Law      the edge that it is less deep behind, so that no energy jumps where a point goes from behind one to behind the
//          other, or out beside a corner
// Covered  an edge between grains whose points are all bonded has the other grain in front of it: it answers for no
//          other particle, or what slides along a particle would run into the faces of its grains (the "internal edges"
//          of game engines). Of two grains the one answers that the point is in; in a valley between them, where it is
//          beside both outer faces, the way out leads to the corner, so that no energy jumps from the one to the other
#pragma once

#include "systems/contact/projection.hpp"

namespace pulvis {

inline bool has_corners(const Shape& shape) {
  return entry(shape.edges, 0).previous == Shape::no_edge;
}

class Corners {
 public:
  Corners(const Bodies& bodies, const std::uint8_t* covered)
      : bodies_(bodies), covered_(covered), any_(std::ranges::any_of(bodies.shapes, has_corners)) {}

  bool any() const { return any_; }

  // True when some point belongs to another edge now.
  [[gnu::noinline]] bool settle(Projection& p, const PointMotion& m) const {
    std::array<double, lane_count> gap;
    m.gap.store(gap.data());
    bool moved = false;
    for (int l = 0; l < lane_count; ++l) {
      if (!(entry(gap, l) > 0) || !entry(p.other.round_corners, l / edge_points)) continue;
      const Shape& shape = bodies_.shape_of_slot(entry(p.other.slot, l / edge_points));
      if (has_corners(shape)) moved |= settle(p, shape, l, entry(gap, l));
    }
    if (!moved) return false;
    p.curve = gather(p.other, p.other.position, p.at);
    p.offset();
    return true;
  }

 private:
  // Of the edge's length: farther from it nobody comes in from a valley.
  static constexpr double near_corner = 0.25;

  struct Foot {
    int edge;
    double u, depth;  // depth m, behind the edge
  };

  bool is_covered(const Projection& p, int half, std::int64_t control) const {
    return entry(p.other.strangers, half) && covered_[entry(p.other.first, half) + control] != 0;
  }

  bool settle(Projection& p, const Shape& shape, int l, double depth) const {
    const int half = l / edge_points, number = edge_number(shape, entry(p.at.edge, l));
    const Shape::Edge& edge = entry(shape.edges, number);
    const bool covered = is_covered(p, half, edge.first_control);
    Foot best{Shape::no_edge, 0, covered ? std::numeric_limits<double>::infinity() : depth};
    bool in_neighbour = false, behind_corner = false;
    const int count = static_cast<int>(shape.edges.size());
    for (const bool forward : {true, false}) {
      if ((forward ? edge.next : edge.previous) != Shape::no_edge) continue;
      const int around = (number + (forward ? 1 : count - 1)) % count;
      const AroundCorner at = edge_around_corner(shape, number, forward,
                                                 p.other.position + 2 * entry(p.other.first, half),
                                                 {p.points.x[l], p.points.y[l]});
      if (is_covered(p, half, entry(shape.edges, around).first_control)) {
        in_neighbour |= !covered && at.edge != Shape::no_edge && !at.behind;
        continue;
      }
      const Foot foot = foot_on(p, shape, l, around, forward);
      if (foot.edge == Shape::no_edge) continue;
      const bool at_corner = foot.edge == around && foot.u == (forward ? 0 : 1);
      if (at_corner ? covered && at.behind && best.edge == Shape::no_edge &&
                          at.distance < near_corner * edge.length
                    : foot.depth < best.depth) {
        best = foot;
        behind_corner = at_corner;
      }
    }
    const unsigned lane = 1U << l;
    if (in_neighbour || (covered && best.edge == Shape::no_edge)) {
      p.beyond |= lane;
      p.inside &= ~lane;
      return true;
    }
    if (best.edge == Shape::no_edge) return false;
    entry(p.at.edge, l) = entry(shape.edges, best.edge).first_control;
    p.at.u[l] = best.u;
    p.beyond &= ~lane;
    p.inside = behind_corner ? p.inside | lane : p.inside & ~lane;
    return true;
  }

  // Newton's method from the corner, along the face. None where the point is beside its other end.
  static Foot foot_on(const Projection& p, const Shape& shape, int l, int edge, bool forward) {
    constexpr int steps = 6;  // an edge
    const int count = static_cast<int>(shape.edges.size());
    for (bool ends = false; !ends; edge = (edge + (forward ? 1 : count - 1)) % count) {
      const Shape::Edge& at = entry(shape.edges, edge);
      const double* y =
          p.other.position + 2 * (entry(p.other.first, l / edge_points) + at.first_control);
      const auto x_of = kernels::cubic(y[0], y[2], y[4], y[6]);
      const auto y_of = kernels::cubic(y[1], y[3], y[5], y[7]);
      double u = forward ? 0 : 1;
      for (int i = 0; i < steps; ++i) {
        const double rx = p.points.x[l] - x_of.value(u), ry = p.points.y[l] - y_of.value(u);
        u = std::clamp(u + kernels::closest_point_step(rx, ry, x_of.slope(u), y_of.slope(u),
                                                       x_of.curvature(u), y_of.curvature(u)),
                       0.0, 1.0);
      }
      ends = (forward ? at.next : at.previous) == Shape::no_edge;
      if (u == (forward ? 1 : 0)) continue;
      const double sx = x_of.slope(u), sy = y_of.slope(u);
      const double rx = p.points.x[l] - x_of.value(u), ry = p.points.y[l] - y_of.value(u);
      return {edge, u, -(rx * sy - ry * sx) / std::sqrt(sx * sx + sy * sy)};
    }
    return {Shape::no_edge, 0, 0};
  }

  const Bodies& bodies_;
  const std::uint8_t* covered_;  // [control points], by the first of an edge; null: none is
  bool any_;
};

}  // namespace pulvis
