// edge_contact: narrow phase between particles: the Gauss points of every candidate edge against the
// smooth curve of the other particle, with pressure, damping and friction.
//
// Source   systems/contact_kernel.hpp
// Runs     after bin_edges, before contact_force
// Active   when the scene has more than one particle
#include <oneapi/tbb/parallel_for.h>

#include "systems/broad_phase.hpp"
#include "systems/contact_row.hpp"
#include "systems/run_failure.hpp"
#include "systems/systems.hpp"

namespace pulvis {
namespace {

// The other particle's curve as the closest-point search walks it: positions, velocities, edges.
struct OtherCurve {
  const Shape& shape;
  const double* position;
  const double* velocity;  // null where the scene needs none
};

struct LaneEdges {
  std::array<int, 4> edge;
  Lane u;
};

LaneEdges unpack(const double* closest) {
  LaneEdges at;
  for (int l = 0; l < 4; ++l) {
    at.edge[static_cast<std::size_t>(l)] = static_cast<int>(closest[l]);
    at.u[l] = closest[l] - at.edge[static_cast<std::size_t>(l)];
  }
  return at;
}

void pack(double* closest, const LaneEdges& at) {
  for (int l = 0; l < 4; ++l) {
    const double inside = std::min(at.u[l], 1 - 1e-12);  // an end belongs to its own edge
    closest[l] = at.edge[static_cast<std::size_t>(l)] + inside;
  }
}

struct CurveLanes {
  kernels::Cubic<Lane> x, y;
};

CurveLanes gather(const Shape& shape, const double* points, const std::array<int, 4>& edge) {
  const double* p[4];
  for (std::size_t l = 0; l < 4; ++l)
    p[l] = points + 2 * shape.edges[static_cast<std::size_t>(edge[l])].first_control;
  const auto at = [&](int k) { return Lane{p[0][k], p[1][k], p[2][k], p[3][k]}; };
  return {kernels::cubic(at(0), at(2), at(4), at(6)), kernels::cubic(at(1), at(3), at(5), at(7))};
}

// Points that leave their edge go on in the next one, or stop at a corner.
void cross_edges(const Shape& shape, LaneEdges& at) {
  for (std::size_t l = 0; l < 4; ++l) {
    const int lane = static_cast<int>(l);
    if (at.u[lane] >= 0 && at.u[lane] <= 1) continue;
    const Shape::Edge& edge = shape.edges[static_cast<std::size_t>(at.edge[l])];
    const bool forward = at.u[lane] > 1;
    const int neighbour = forward ? edge.next : edge.previous;
    if (neighbour == Shape::no_edge) {
      at.u[lane] = forward ? 1 : 0;
    } else {
      at.edge[l] = neighbour;
      at.u[lane] = std::clamp(at.u[lane] + (forward ? -1 : 1), 0.0, 1.0);
    }
  }
}

constexpr int most_steps = 40;
constexpr double step_tolerance = 1e-8;  // of an edge; the gap is then exact to its square

// Where the four points stand against the curve. `beyond`: closest to a corner, from outside its edge.
struct Closest {
  LaneEdges at;
  CurveLanes curve;
  Lane rx, ry;  // from the curve to the point, m
  LaneMask beyond;
};

[[gnu::flatten]] Closest closest_points(const OtherCurve& other, const PointLanes& points,
                                        LaneEdges start) {
  Closest c{start, {}, {}, {}, {}};
  for (int step = 0;; ++step) {
    c.curve = gather(other.shape, other.position, c.at.edge);
    c.rx = points.x - c.curve.x.value(c.at.u);
    c.ry = points.y - c.curve.y.value(c.at.u);
    Lane du =
        kernels::closest_point_step(c.rx, c.ry, c.curve.x.slope(c.at.u), c.curve.y.slope(c.at.u),
                                    c.curve.x.curvature(c.at.u), c.curve.y.curvature(c.at.u));
    du = min(max(du, broadcast(-1)), broadcast(1));
    const LaneMask small = abs(du) < step_tolerance;
    if (all(small)) return c;
    const LaneEdges before = c.at;
    c.at.u += du;
    if (!any((c.at.u < 0.0) | (c.at.u > 1.0)) && step < most_steps) continue;
    cross_edges(other.shape, c.at);
    // Also done when every other lane pushes against a corner that it stands at.
    LaneMask stays{};
    for (std::size_t l = 0; l < 4; ++l) {
      const int i = static_cast<int>(l);
      stays[i] = before.edge[l] == c.at.edge[l] && before.u[i] == c.at.u[i] ? -1 : 0;
    }
    c.beyond = stays & ~small;
    if (all(small | stays) || step == most_steps) {
      c.at = before;
      return c;
    }
  }
}

// How the points move against the curve; both rates vanish in a common rigid motion.
[[gnu::flatten]] RowMotion row_motion(const OtherCurve& other, const Closest& c,
                                      const PointLanes& velocity) {
  const Lane sx = c.curve.x.slope(c.at.u), sy = c.curve.y.slope(c.at.u);
  const Lane over_length = 1.0 / sqrt(sx * sx + sy * sy);
  RowMotion m{};
  m.nx = sy * over_length;
  m.ny = -sx * over_length;
  m.gap = -(c.rx * m.nx + c.ry * m.ny);
  if (other.velocity != nullptr) {
    const CurveLanes v = gather(other.shape, other.velocity, c.at.edge);
    const Lane wx = velocity.x - v.x.value(c.at.u), wy = velocity.y - v.y.value(c.at.u);
    const Lane turn = (v.x.slope(c.at.u) * m.nx + v.y.slope(c.at.u) * m.ny) * over_length;
    m.gap_rate = -(wx * m.nx + wy * m.ny);
    m.slip_rate = (wy * m.nx - wx * m.ny) - m.gap * turn;
  }
  return m;
}

// An outline against itself: two parts of it that meet from outside, where it folds. From inside each point
// is at some depth below the far side of its own body: a row that begins like that, or deeper than contacts
// get, is none. Points whose closest point is their own neighbourhood do not touch.
bool is_far_side(const Closest& c, int edge, int edges, double length, bool unseen, Lane& gap) {
  for (std::size_t l = 0; l < 4; ++l)
    if (edges_between(c.at.edge[l], edge, edges) < least_fold) gap[static_cast<int>(l)] = -1;
  if (!any(gap > 0.0)) return unseen && any(c.beyond);
  return unseen || greatest(gap) > 0.25 * length;
}

// The force on the other body's slope that makes friction free of torque: -T g/|x'| n.
void set_couple(const Closest& c, const RowMotion& m, Lane along, double* couple) {
  const Lane sx = c.curve.x.slope(c.at.u), sy = c.curve.y.slope(c.at.u);
  const Lane size = along * m.gap / sqrt(sx * sx + sy * sy);
  put(couple, size * m.nx);
  put(couple + edge_points, size * m.ny);
}

}  // namespace

void edge_contact(Read<Bodies> bodies, Read<Clock> clock, Read<CurvePosition> position,
                  Optional<Read<CurveVelocity>> velocity, Write<ClosestPoint> closest,
                  Write<ContactPair<Contact>> pair, Write<ContactReach<Contact>> reach,
                  Read<ContactStiffness<Contact>> stiffness, Read<ContactWeight<Contact>> weight,
                  Read<EdgeLength<Contact>> length, Write<PointForce<Contact>> force,
                  Write<Penetration<Contact>> penetration, Write<ContactEnergy<Contact>> energy,
                  Optional<Read<FrictionCoefficient<Contact>>> friction,
                  Optional<Write<ElasticSlip<Contact>>> elastic_slip,
                  Optional<Write<FrictionWork<Contact>>> friction_work,
                  Optional<Write<FrictionCouple>> couple,
                  Optional<Read<DampingCoefficient<Contact>>> damping,
                  Optional<Write<DampingWork<Contact>>> damping_work) {
  const RowColumns<Contact> columns{pair,          reach,       stiffness,   weight,   length,
                                    force,         penetration, energy,      friction, elastic_slip,
                                    friction_work, damping,     damping_work};
  const double* points = position.values().data();
  const double* rates = velocity ? velocity->values().data() : nullptr;
  const auto control = [&](int slot) {
    return 2 *
           static_cast<std::size_t>(bodies->slots[static_cast<std::size_t>(slot)].first_control);
  };

  const auto look_at = [&](Row<Contact> row) {
    if (clock->travel < reach(row)) return;
    const int slot = pair(row, 0), partner = pair(row, 2);
    const Shape::Edge& edge =
        bodies->shape_of_slot(slot).edges[static_cast<std::size_t>(pair(row, 1))];
    const std::size_t first = control(slot) + 2 * static_cast<std::size_t>(edge.first_control);
    const OtherCurve other{bodies->shape_of_slot(partner), points + control(partner),
                           rates != nullptr ? rates + control(partner) : nullptr};
    const PointLanes at = edge_points_at(points + first);
    const Closest c = closest_points(other, at, unpack(&closest(row)));
    pack(&closest(row), c.at);

    const PointLanes speed = rates != nullptr ? edge_points_at(rates + first) : PointLanes{};
    RowMotion motion = row_motion(other, c, speed);
    motion.gap = c.beyond ? broadcast(-1) : motion.gap;  // past a corner: outside the other body
    if (partner == slot) {
      const int edges = static_cast<int>(other.shape.edges.size());
      if (is_far_side(c, pair(row, 1), edges, edge.length, reach(row) == unseen, motion.gap)) {
        set_apart(columns, row, far_side);
        return;
      }
    }
    if (!any(motion.gap > 0.0)) {
      set_apart(columns, row, clock->travel + std::sqrt(least(c.rx * c.rx + c.ry * c.ry)));
      return;
    }
    const Lane along = set_touching(columns, row, motion, 0.5, clock->dt_before);
    if (couple) set_couple(c, motion, along, &(*couple)(row));
  };
  tbb::parallel_for(0, pair.rows(), [&](int row) { look_at(Row<Contact>(row)); });
}

}  // namespace pulvis
