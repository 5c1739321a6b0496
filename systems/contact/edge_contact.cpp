// edge_contact: narrow phase between particles: the Gauss points of every candidate edge against the
// smooth curve of the other particle, with pressure, damping and friction.
//
// Source   systems/contact/contact_kernel.hpp
// Runs     after bin_edges, before contact_force
// Active   when the scene has more than one particle, or one whose outline can fold
#include "engine/entry.hpp"
#include "engine/run_failure.hpp"
#include "systems/contact/broad_phase.hpp"
#include "systems/contact/contact_outlines.hpp"
#include "systems/contact/contact_row.hpp"
#include "systems/contact/systems.hpp"
#include "systems/contact/winding_kernel.hpp"

namespace pulvis {
namespace {

constexpr std::size_t lanes = lane_count;
constexpr unsigned all_lanes = (1U << lane_count) - 1;
constexpr unsigned half_of(unsigned bits, int half) { return bits >> (half * edge_points) & 15; }

// The curves of the other particles as the closest-point search walks them, of both rows.
struct OtherCurves {
  std::array<int, 2> slot;
  std::array<std::size_t, 2> first;  // control point of the outline
  const double* position;            // of all control points
  const double* velocity;            // null where the scene needs none
};

using Indices = std::array<std::int64_t, lanes>;

// Edges go by their first control point here, counted in their outline.
struct LaneEdges {
  Indices edge;
  Lane u;
};

LaneEdges unpack(const Lane& closest) {
  LaneEdges at;
  std::array<double, lanes> from, u;
  closest.store(from.data());
  for (std::size_t l = 0; l < lanes; ++l) {
    at.edge[l] = static_cast<std::int64_t>(from[l]);
    u[l] = from[l] - static_cast<double>(at.edge[l]);
  }
  at.u = Lane::load(u.data());
  return at;
}

Lane pack(const LaneEdges& at) {
  const Lane edge = Lane::from([&](int l) { return static_cast<double>(entry(at.edge, l)); });
  return edge + min(at.u, 1 - 1e-12);  // an end belongs to its own edge
}

struct CurveLanes {
  kernels::Cubic<Lane> x, y;
};

// Functions of one pair of rows that are inline in the loop over all: what they pass stays in registers then.
[[gnu::always_inline, gnu::flatten]] inline CurveLanes gather(const OtherCurves& other,
                                                              const double* points,
                                                              const Indices& edge) {
  const std::array<const double*, 2> outline{points + 2 * other.first[0],
                                             points + 2 * other.first[1]};
  std::array<const double*, lanes> control;
  for (std::size_t l = 0; l < lanes; ++l) control[l] = outline[l / edge_points] + 2 * edge[l];
  const auto y = columns_of(control);
  return {kernels::cubic(y[0], y[2], y[4], y[6]), kernels::cubic(y[1], y[3], y[5], y[7])};
}

int edge_number(const Shape& shape, std::int64_t first_control) {
  return entry(shape.edge_from, first_control);
}

// Points that leave their edge go on in the next one, or stop at a corner. Returns the lanes that stand
// where they stood, at a corner.
unsigned cross_edges(const Bodies& bodies, const OtherCurves& other, const Lane& before,
                     LaneEdges& at) {
  std::array<double, lanes> u, u_before;
  at.u.store(u.data());
  before.store(u_before.data());
  unsigned stay = 0;
  for (std::size_t l = 0; l < lanes; ++l) {
    if (u[l] >= 0 && u[l] <= 1) continue;
    const Shape& shape = bodies.shape_of_slot(other.slot[l / edge_points]);
    const Shape::Edge& edge = entry(shape.edges, edge_number(shape, at.edge[l]));
    const bool forward = u[l] > 1;
    const int neighbour = forward ? edge.next : edge.previous;
    if (neighbour == Shape::no_edge) {
      u[l] = forward ? 1 : 0;
      if (u[l] == u_before[l]) stay |= 1U << l;
    } else {
      at.edge[l] = entry(shape.edges, neighbour).first_control;
      u[l] = std::clamp(u[l] + (forward ? -1 : 1), 0.0, 1.0);
    }
  }
  at.u = Lane::load(u.data());
  return stay;
}

constexpr int max_steps = 41;
// Of an edge. A Newton step that short leaves about its square, and the gap is exact to the square of that. (With 1e-5
// the normals carry so much round-off on that micrometres and metres part by more than 1e-9; docs/performance.md.)
constexpr double step_tolerance = 2e-6;

// Where the points of a pair of rows stand against the other curves. `beyond`: closest to a corner, from outside
// its edge.
struct Closest {
  OtherCurves other;
  PointLanes points;
  LaneEdges at;
  CurveLanes curve;
  Lane rx, ry;  // from the curve to the point, m
  unsigned beyond = 0, done = 0;

  [[gnu::always_inline]] void offset() {
    rx = points.x - curve.x.value(at.u);
    ry = points.y - curve.y.value(at.u);
  }
  // Every lane stops by itself, so that no point depends on the others.
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
  // Seldom: outside the loop of Newton steps.
  [[gnu::noinline]] void cross(const Bodies& bodies, const Lane& before) {
    beyond |= cross_edges(bodies, other, before, at);
    done |= beyond;
    curve = gather(other, other.position, at.edge);
  }
};

// How the points move against the curves; both rates vanish in a common rigid motion.
[[gnu::always_inline, gnu::flatten]] inline RowMotion row_motion(const Closest& c,
                                                                 const PointLanes& velocity) {
  const Lane sx = c.curve.x.slope(c.at.u), sy = c.curve.y.slope(c.at.u);
  const Lane inv_length = 1.0 / sqrt(fma(sx, sx, sy * sy));
  RowMotion m;
  m.over_slope = inv_length;
  m.nx = sy * inv_length;
  m.ny = -sx * inv_length;
  m.gap = -fma(c.rx, m.nx, c.ry * m.ny);
  if (c.other.velocity != nullptr) {
    const CurveLanes v = gather(c.other, c.other.velocity, c.at.edge);
    const Lane wx = velocity.x - v.x.value(c.at.u), wy = velocity.y - v.y.value(c.at.u);
    const Lane turn = fma(v.x.slope(c.at.u), m.nx, v.y.slope(c.at.u) * m.ny) * inv_length;
    m.gap_rate = -fma(wx, m.nx, wy * m.ny);
    m.slip_rate = fma(wy, m.nx, -(wx * m.ny)) - m.gap * turn;
  } else {
    m.gap_rate = m.slip_rate = Lane{};
  }
  return m;
}

// An outline against itself: two parts of it that meet from outside, where it folds. Seen from inside, each point
// is at some depth below the back face of its own body, too. What tells them apart: half way to the closest point the
// outline is gone round once there, and twice where it overlaps itself.
class OwnOutline {
 public:
  OwnOutline(const Shape& shape, const double* control) : shape_(shape), control_(control) {}

  // Half way from the closest point on the edge `there`, against whose normal it sees the point on `edge`. Both
  // are known to be passed as curves are; chords stand for all the others.
  bool overlaps(int edge, int there, const Point& half_way, const Point& back) const {
    int times = 1;  // through the point itself, out of its own part
    for (int e = 0; e < static_cast<int>(shape_.edges.size()); ++e)
      if (e != edge && e != there)
        times += kernels::crossing(half_way, back, knot(e, 0), knot(e, 1));
    return times > 1;
  }
  Point normal(int edge, double u) const { return curve(edge).normal(u); }
  int edges() const { return static_cast<int>(shape_.edges.size()); }

 private:
  Curve curve(int edge) const {
    return Curve(control_ + 2 * entry(shape_.edges, edge).first_control);
  }
  Point knot(int edge, int end) const {
    const double* y = control_ + 2 * (entry(shape_.edges, edge).first_control + end);
    return {(y[0] + 4 * y[2] + y[4]) / 6, (y[1] + 4 * y[3] + y[5]) / 6};
  }

  const Shape& shape_;
  const double* control_;
};

// Of an edge: no contact begins deeper; its spring would be stiffer at once than the time step knows. (What got there
// unseen, outline_health tells.)
constexpr double deepest_begin = 0.1;

// Of a row against its own outline: takes out the points that do not touch, those that touched in the step before
// (`touched`) apart, and returns how near the others are, m: endless where all see their own neighbourhood or the
// back face. (A contact may get as deep as limits.penetration lets it.)
double leave_folds(const Closest& c, int half, int edge, const OwnOutline& own, const Shape& shape,
                   unsigned touched, RowMotion& m) {
  const double deepest = deepest_begin * entry(shape.edges, edge).length;
  double nearest = back_face;
  for (int g = 0; g < edge_points; ++g) {
    const int l = half * edge_points + g;
    const int there = edge_number(shape, entry(c.at.edge, l));
    const Point n = own.normal(edge, kernels::edge_u[g]), back{-m.nx[l], -m.ny[l]};
    const double product = -(n[0] * back[0] + n[1] * back[1]);
    const bool near = edges_between(there, edge, own.edges()) < min_fold;
    if (there == edge || (near && product > sharp_fold)) {
      m.gap[l] = -1;
    } else if (!(m.gap[l] > 0)) {
      nearest = std::min(nearest, std::sqrt(c.rx[l] * c.rx[l] + c.ry[l] * c.ry[l]));
    } else {
      const bool before = (touched >> g & 1) != 0, deep = m.gap[l] > deepest;
      if (before && !deep) continue;
      const Point half_way{c.points.x[l] - 0.5 * c.rx[l], c.points.y[l] - 0.5 * c.ry[l]};
      if (product > 0 || (deep && !before) || !own.overlaps(edge, there, half_way, back))
        m.gap[l] = -1;
    }
  }
  return nearest;
}

// The force on the other bodies' slope that makes friction free of torque: -T g/|x'| n.
void set_couple(const RowMotion& m, const Lane& along, unsigned touching,
                const RowPair<Contact>& rows, const Write<FrictionCouple>& couple) {
  const Lane size = along * m.gap * m.over_slope;
  const Lane x = size * m.nx, y = size * m.ny;
  for (int half = 0; half < 2; ++half) {
    if ((touching >> half & 1) == 0) continue;
    store_pairs_of_half(x, y, half, &couple(entry(rows, half)));
  }
}

}  // namespace

void edge_contact::operator()(SmallTasks) const {
  const double* points = curves.position.values().data();
  const double* rates = curves.velocity ? curves.velocity->values().data() : nullptr;
  const auto number = [](std::int32_t control) { return static_cast<std::size_t>(control); };

  const auto begin = [&](const RowPair<Contact>& rows) __attribute__((always_inline)) {
    Closest c;
    c.other = {{columns.pair(rows[0], 2), columns.pair(rows[1], 2)},
               {number(place(rows[0], 1)), number(place(rows[1], 1))},
               points,
               rates};
    c.points = edge_points_at(points + 2 * number(place(rows[0], 0)),
                              points + 2 * number(place(rows[1], 0)));
    c.at = unpack(at_points(closest, rows));
    c.curve = gather(c.other, points, c.at.edge);
    return c;
  };
  const auto motion_at = [&](const RowPair<Contact>& rows, Closest& c)
      __attribute__((always_inline)) {
    c.offset();
    const Lane found = pack(c.at);
    for (int i = 0; i < 2; ++i) store_half(found, i, &closest(entry(rows, i)));
    const PointLanes speed = rates != nullptr
                                 ? edge_points_at(rates + 2 * number(place(rows[0], 0)),
                                                  rates + 2 * number(place(rows[1], 0)))
                                 : PointLanes{};
    RowMotion motion = row_motion(c, speed);
    // Past a corner: outside the other body.
    motion.gap = select(LaneMask::of(c.beyond), -1.0, motion.gap);
    return motion;
  };
  const auto nearest_fold = [&](Row<Contact> row, int half, const Closest& c, RowMotion& motion) {
    const Shape& shape = bodies->shape_of_slot(columns.pair(row, 2));
    unsigned touched = 0;
    for (int g = 0; columns.touches(row) != 0 && g < edge_points; ++g)
      if (columns.force(row, 2 * g) != 0 || columns.force(row, 2 * g + 1) != 0) touched |= 1U << g;
    return leave_folds(c, half, columns.pair(row, 1), {shape, points + 2 * number(place(row, 1))},
                       shape, touched, motion);
  };
  const auto act = [&](const RowPair<Contact>& rows, const Closest& c, RowMotion& motion,
                       LaneSums& sum) __attribute__((always_inline)) {
    unsigned touching = 0;
    for (int i = 0; i < rows_in(rows); ++i) {
      const Row<Contact> row = entry(rows, i);
      const bool itself = columns.pair(row, 2) == columns.pair(row, 0);
      const double nearest = itself ? nearest_fold(row, i, c, motion) : 0;
      if (half_of((motion.gap > 0.0).bits(), i) != 0) {
        touching |= 1U << i;
      } else {
        const Lane square = c.rx * c.rx + c.ry * c.ry;
        set_apart(columns, row,
                  clock->travel + (itself ? nearest : std::sqrt(min_of_half(square, i))));
      }
    }
    if (touching == 0) return;
    const Lane along = set_touching(columns, rows, touching, motion, 0.5, clock->dt_before, sum);
    if (couple) set_couple(motion, along, touching, rows, *couple);
  };
  const auto look_at = [&](const RowPair<Contact>& rows, LaneSums& sum) {
    Closest c = begin(rows);
    for (int step = 0; c.done != all_lanes && step < max_steps; ++step) c.step(*bodies);
    RowMotion motion = motion_at(rows, c);
    act(rows, c, motion, sum);
  };
  const auto look_at_two = [&](const RowPair<Contact>& a, const RowPair<Contact>& b,
                               LaneSums& sum) {
    Closest to_a = begin(a), to_b = begin(b);
    for (int step = 0; (to_a.done & to_b.done) != all_lanes && step < max_steps; ++step) {
      to_a.step(*bodies);
      to_b.step(*bodies);
    }
    RowMotion of_a = motion_at(a, to_a), of_b = motion_at(b, to_b);
    act(a, to_a, of_a, sum);
    act(b, to_b, of_b, sum);
  };
  for_active_pairs<Contact>(
      columns.pair.rows(), *sums,
      [&](Row<Contact> row) { return clock->travel >= columns.reach(row); },
      [&](Row<Contact> row) {
        fetch(columns, row);
        prefetch(&place(row));
        prefetch(&closest(row));
        if (couple) prefetch(&(*couple)(row));
      },
      [&](Row<Contact> row) {  // both outlines, the other where it was met last
        const std::size_t other =
            2 * (number(place(row, 1)) + static_cast<std::size_t>(closest(row, 1)));
        const std::size_t own = 2 * number(place(row, 0));
        for (const double* list : {points, rates}) {
          if (list == nullptr) continue;
          for (const std::size_t at : {other, own}) {
            prefetch(list + at);
            prefetch(list + at + 8);
          }
        }
      },
      look_at, look_at_two);
}

}  // namespace pulvis
