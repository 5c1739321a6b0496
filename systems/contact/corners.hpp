// Corners of the other outline: which of the two edges that meet there handles a point that is behind one of them.
//
// Law      the edge with the smaller depth, so that the energy does not jump where a point moves from behind one edge to
//          behind the other, or out past a corner. Faces between bonded grains count, too: at a joint the potential of a
//          point that slides along the particle dips to zero and recovers, over a width equal to the depth of the point
#pragma once

#include "systems/contact/projection.hpp"

namespace pulvis {

inline bool has_corners(const Shape& shape) {
  return entry(shape.edges, 0).previous == Shape::no_edge;
}

class Corners {
 public:
  explicit Corners(const Bodies& bodies)
      : bodies_(bodies), any_(std::ranges::any_of(bodies.shapes, has_corners)) {}

  bool any() const { return any_; }

  // Points that another edge may have to handle: behind their own edge, and near its end.
  static unsigned ambiguous(const Projection& p, const PointMotion& m) {
    const Lane from_end = min(p.at.u, 1.0 - p.at.u);
    return ((m.gap > 0.0) & (from_end < reach_of_corner * m.gap * m.inv_slope)).bits();
  }

  // True if some of these points now belong to another edge.
  [[gnu::noinline]] bool settle(unsigned points, Projection& p, const PointMotion& m) const {
    bool moved = false;
    for (int l = 0; l < lane_count; ++l) {
      if ((points >> l & 1) == 0 || !entry(p.other.round_corners, l / edge_points)) continue;
      const Shape& shape = bodies_.shape_of_slot(entry(p.other.slot, l / edge_points));
      if (has_corners(shape)) moved |= settle(p, shape, l, m.gap[l]);
    }
    if (!moved) return false;
    p.curve = gather(p.other, p.other.position, p.at);
    p.offset();
    return true;
  }

 private:
  // A point is less deep behind the other edge of a corner of angle theta only if it is closer to the corner than
  // depth tan(theta/2): up to 170 degrees.
  static constexpr double reach_of_corner = 12;

  struct Foot {
    int edge;
    double u, depth;  // depth m, behind the edge
  };

  static bool settle(Projection& p, const Shape& shape, int l, double depth) {
    const int number = edge_number(shape, entry(p.at.edge, l));
    const Shape::Edge& edge = entry(shape.edges, number);
    Foot best{Shape::no_edge, 0, depth};
    const int count = static_cast<int>(shape.edges.size());
    for (const bool forward : {true, false}) {
      if ((forward ? edge.next : edge.previous) != Shape::no_edge) continue;
      const int around = (number + (forward ? 1 : count - 1)) % count;
      const Foot foot = foot_on(p, shape, l, around, forward);
      if (foot.edge != Shape::no_edge && foot.depth < best.depth) best = foot;
    }
    if (best.edge == Shape::no_edge) return false;
    entry(p.at.edge, l) = entry(shape.edges, best.edge).first_control;
    p.at.u[l] = best.u;
    p.beyond &= ~(1U << l);
    p.inside &= ~(1U << l);
    return true;
  }

  // Newton's method along the face, starting at the corner. None if the point is beside the face.
  static Foot foot_on(const Projection& p, const Shape& shape, int l, int edge, bool forward) {
    constexpr int steps = 6;  // per edge
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
      if (u == (forward ? 0 : 1)) break;
      const double sx = x_of.slope(u), sy = y_of.slope(u);
      const double rx = p.points.x[l] - x_of.value(u), ry = p.points.y[l] - y_of.value(u);
      return {edge, u, -(rx * sy - ry * sx) / std::sqrt(sx * sx + sy * sy)};
    }
    return {Shape::no_edge, 0, 0};
  }

  const Bodies& bodies_;
  bool any_;
};

}  // namespace pulvis
