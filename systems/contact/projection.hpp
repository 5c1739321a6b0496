// Projection: positions and velocities of the Gauss points of two candidates relative to the curves of other outlines.
//
// Method   Newton's for (x_s - x_m) . x_m' = 0, starting at the previous closest point; a step crosses at most one
//          edge, on to the next edge or to a corner
// Lanes    each point stops independently, so that none depends on the others
#pragma once

#include <algorithm>

#include "components/shape.hpp"
#include "engine/access.hpp"
#include "systems/contact/curve_points.hpp"
#include "systems/contact/two_candidates.hpp"
#include "systems/laws/normal_contact.hpp"

namespace pulvis {

// The curves of the other outlines that the search walks along, for both candidates.
struct OtherCurves {
  std::array<int, 2> slot;
  std::array<std::int32_t, 2> first;  // first control point of the outline
  std::array<bool, 2> round_corners;  // search past corners: not where an outline folds onto itself
  const double* position;             // of all control points
  const double* velocity;             // null if the scene needs none
};

struct CurveLanes {
  kernels::Cubic<Lane> x, y;
};

// Functions of two candidates that are inlined into the loop over all: their arguments then stay in registers.
[[gnu::always_inline, gnu::flatten]] inline CurveLanes gather(const OtherCurves& other,
                                                              const double* points,
                                                              const CurvePoints& at) {
  const std::array<const double*, 2> outline{points + 2 * other.first[0],
                                             points + 2 * other.first[1]};
  std::array<const double*, lane_count> control;
  for (std::size_t l = 0; l < lane_count; ++l)
    control[l] = outline[l / edge_points] + 2 * at.edge[l];
  const auto y = columns_of(control);
  return {kernels::cubic(y[0], y[2], y[4], y[6]), kernels::cubic(y[1], y[3], y[5], y[7])};
}

inline int edge_number(const Shape& shape, std::int64_t first_control) {
  return entry(shape.edge_from, first_control);
}

// Position of a point relative to the edge around a corner.
struct AroundCorner {
  int edge = Shape::no_edge;  // if the point is in front of or behind it: not beside it
  bool behind = false;        // behind its line
};
inline AroundCorner edge_around_corner(const Shape& shape, int edge, bool forward,
                                       const double* outline, const Point& p) {
  const int count = static_cast<int>(shape.edges.size());
  const int next = (edge + (forward ? 1 : count - 1)) % count;
  const double* y = outline + 2 * entry(shape.edges, next).first_control + (forward ? 0 : 2);
  const Point way{p[0] - (y[0] + 4 * y[2] + y[4]) / 6, p[1] - (y[1] + 4 * y[3] + y[5]) / 6};
  const Point slope{y[4] - y[0], y[5] - y[1]};
  const double along = way[0] * slope[0] + way[1] * slope[1];
  return {(forward ? along : -along) > 0 ? next : Shape::no_edge,
          way[0] * slope[1] - way[1] * slope[0] < 0};
}

// Points that leave their edge move on to the next one, or around a corner, or stop at it. Returns the lanes that were
// already at that corner.
inline unsigned cross_edges(const Bodies& bodies, const OtherCurves& other,
                            const PointLanes& points, const Lane& before, CurvePoints& at,
                            unsigned& behind_next) {
  std::array<double, lane_count> u, u_before;
  at.u.store(u.data());
  before.store(u_before.data());
  unsigned stay = 0;
  for (std::size_t l = 0; l < lane_count; ++l) {
    if (u[l] >= 0 && u[l] <= 1) continue;
    const Shape& shape = bodies.shape_of_slot(other.slot[l / edge_points]);
    const Shape::Edge& edge = entry(shape.edges, edge_number(shape, at.edge[l]));
    const bool forward = u[l] > 1;
    const int neighbour = forward ? edge.next : edge.previous;
    if (neighbour == Shape::no_edge) {
      u[l] = forward ? 1 : 0;
      if (u[l] != u_before[l]) continue;
      const std::size_t half = l / edge_points;
      const int lane = static_cast<int>(l);
      const AroundCorner around =
          other.round_corners[half]
              ? edge_around_corner(shape, edge_number(shape, at.edge[l]), forward,
                                   other.position + 2 * other.first[half],
                                   {points.x[lane], points.y[lane]})
              : AroundCorner{};
      if (around.edge == Shape::no_edge) {
        stay |= 1U << l;
        if (around.behind) behind_next |= 1U << l;
      } else {
        at.edge[l] = entry(shape.edges, around.edge).first_control;
        u[l] = forward ? 0 : 1;
      }
    } else {
      at.edge[l] = entry(shape.edges, neighbour).first_control;
      u[l] = std::clamp(u[l] + (forward ? -1 : 1), 0.0, 1.0);
    }
  }
  at.u = Lane::load(u.data());
  return stay;
}

struct Projection {
  static constexpr int max_steps = 41;
  // In edge lengths. After a Newton step that short the error is about its square, and the gap is accurate to the square
  // of that. (With 1e-5 the normals carry so much round-off that runs in micrometres and in metres differ by more than
  // 1e-9; docs/performance.md.)
  static constexpr double step_tolerance = 2e-6;

  OtherCurves other;
  PointLanes points;
  CurvePoints at;
  CurveLanes curve;
  Lane rx, ry;          // from the curve to the point, m
  unsigned beyond = 0;  // lanes closest to a corner, from outside their edge
  unsigned inside = 0;  // among those, the ones inside a body behind a re-entrant corner
  unsigned done = 0;    // lanes that have converged

  unsigned unconverged() const { return ~done & all_lanes; }

  [[gnu::always_inline]] void offset() {
    rx = points.x - curve.x.value(at.u);
    ry = points.y - curve.y.value(at.u);
  }
  [[gnu::always_inline]] void step(const Bodies& bodies) {
    offset();
    const Lane full_step =
        kernels::closest_point_step(rx, ry, curve.x.slope(at.u), curve.y.slope(at.u),
                                    curve.x.curvature(at.u), curve.y.curvature(at.u));
    const Lane du = min(max(full_step, -1.0), 1.0);
    const Lane before = at.u;
    at.u = select(LaneMask::of(done), before, before + du);
    done |= (abs(du) < step_tolerance).bits();
    if (any((at.u < 0.0) | (at.u > 1.0))) cross(bodies, before);
  }
  // Rare: kept out of the Newton loop.
  [[gnu::noinline]] void cross(const Bodies& bodies, const Lane& before) {
    unsigned behind_next = 0;
    beyond |= cross_edges(bodies, other, points, before, at, behind_next);
    done |= beyond;
    curve = gather(other, other.position, at);
    if (behind_next == 0) return;
    offset();
    const LaneMask behind = fma(rx, curve.y.slope(at.u), -(ry * curve.x.slope(at.u))) < 0.0;
    inside |= behind_next & behind.bits();
  }
};

// Runs all of them to convergence, side by side.
template <class... Projections>
[[gnu::always_inline]] inline void project(const Bodies& bodies, Projections&... all) {
  for (int step = 0; (all.done & ...) != all_lanes && step < Projection::max_steps; ++step)
    (all.step(bodies), ...);
  (all.offset(), ...);
}

// Behind a re-entrant corner the way out leads to the corner itself.
[[gnu::noinline]] inline void look_to_corners(const Projection& p, const LaneMask& lanes,
                                              PointMotion& m) {
  const Lane distance = sqrt(fma(p.rx, p.rx, p.ry * p.ry));
  const LaneMask apart = lanes & (distance > 0.0);
  m.nx = select(apart, -(p.rx / distance), m.nx);
  m.ny = select(apart, -(p.ry / distance), m.ny);
}

// Motion of the points relative to the curves; both rates vanish in a common rigid motion. Past a corner a point is
// outside the other body.
[[gnu::always_inline, gnu::flatten]] inline PointMotion motion_of(const Projection& p,
                                                                  const PointLanes& velocity) {
  const Lane sx = p.curve.x.slope(p.at.u), sy = p.curve.y.slope(p.at.u);
  const Lane inv_length = 1.0 / sqrt(fma(sx, sx, sy * sy));
  PointMotion m;
  m.inv_slope = inv_length;
  m.nx = sy * inv_length;
  m.ny = -sx * inv_length;
  if (p.inside != 0) look_to_corners(p, LaneMask::of(p.inside), m);
  m.gap = -fma(p.rx, m.nx, p.ry * m.ny);
  if (p.other.velocity != nullptr) {
    const CurveLanes v = gather(p.other, p.other.velocity, p.at);
    const Lane wx = velocity.x - v.x.value(p.at.u), wy = velocity.y - v.y.value(p.at.u);
    const Lane turn = fma(v.x.slope(p.at.u), m.nx, v.y.slope(p.at.u) * m.ny) * inv_length;
    m.gap_rate = -fma(wx, m.nx, wy * m.ny);
    m.slip_rate = fma(wy, m.nx, -(wx * m.ny)) - m.gap * turn;
  } else {
    m.gap_rate = m.slip_rate = Lane{};
  }
  m.gap = select(LaneMask::of(p.beyond & ~p.inside), -1.0, m.gap);
  return m;
}

// The hardness of the sampled edges, given by their first control points, and of those that their points are closest to.
inline kernels::Hardness<Lane> hardness_at(const Read<SurfaceHardness<TwoD>>& of,
                                           const Projection& p,
                                           const std::array<std::int32_t, 2>& sampled) {
  std::array<std::int32_t, lane_count> other;
  for (int l = 0; l < lane_count; ++l)
    entry(other, l) = entry(p.other.first, l / edge_points) +
                      static_cast<std::int32_t>(entry(p.at.edge, l));
  const auto softer = [&](int number) {
    return min(halves(of(Row<ControlPoint>(sampled[0]), number),
                      of(Row<ControlPoint>(sampled[1]), number)),
               Lane::from([&](int l) { return of(Row<ControlPoint>(entry(other, l)), number); }));
  };
  return {softer(SurfaceHardness<TwoD>::pressure), softer(SurfaceHardness<TwoD>::left)};
}

// Past a corner the corner itself attracts: the distance to an outline is continuous there, so no energy is lost when
// a point passes from an edge to beside it.
[[gnu::noinline]] inline void attract_to_corners(const Projection& p, PointMotion& m) {
  const Lane distance = sqrt(fma(p.rx, p.rx, p.ry * p.ry));
  const LaneMask corner = LaneMask::of(p.beyond & ~p.inside) & (distance > 0.0);
  m.nx = select(corner, p.rx / distance, m.nx);
  m.ny = select(corner, p.ry / distance, m.ny);
  m.gap = select(corner, -distance, m.gap);
}

}  // namespace pulvis
