// edge_contact: narrow phase between particles: the Gauss points of every candidate edge against the
// smooth curve of the other particle, with pressure, damping and friction.
//
// Stages   active_pairs -> projection -> own_outline -> contact_law -> contact_sums (systems/contact/two_candidates.hpp)
// Runs     after bin_edges, before contact_force
// Active   when the scene has more than one particle, or one whose outline can fold
#include "engine/prefetch.hpp"
#include "systems/contact/active_pairs.hpp"
#include "systems/contact/contact_law.hpp"
#include "systems/contact/corners.hpp"
#include "systems/contact/own_outline.hpp"
#include "systems/contact/projection.hpp"
#include "systems/contact/systems.hpp"

namespace pulvis {
namespace {

using Two = TwoCandidates<Contact>;

// The force on the slope of the other bodies that makes friction torque-free: -T g/|x'| n.
void set_slope_load(const PointMotion& m, const Lane& along, unsigned touching, const Two& two,
                    const Write<SlopeLoad>& slope_load) {
  const Lane size = along * m.gap * m.inv_slope;
  const Lane x = size * m.nx, y = size * m.ny;
  for (int half = 0; half < 2; ++half) {
    if ((touching >> half & 1) == 0) continue;
    store_pairs_of_half(x, y, half, &slope_load(entry(two, half)));
  }
}

// One pass over the active pairs. Functions inlined into the loop over all keep their arguments in registers.
struct EdgePass {
  static constexpr double share = 0.5;  // of the stiffness: the other particle is sampled too
  using Sums = LaneSums;
  const edge_contact& s;
  const double* points = s.curves.position.values().data();
  const double* rates = s.curves.velocity ? s.curves.velocity->values().data() : nullptr;
  const Corners corners{*s.bodies};

  // ---- active pairs
  [[gnu::always_inline]] bool active(Row<Contact> row) const {
    return s.clock->relative_motion >= s.columns.state.activation(row);
  }
  [[gnu::always_inline]] void fetch(Row<Contact> row) const {
    pulvis::fetch(s.columns, row);
    prefetch(&s.points.place(row));
    prefetch(&s.points.closest(row));
    if (s.points.slope_load) prefetch(&(*s.points.slope_load)(row));
  }
  // Both outlines, the other one at its last closest point.
  [[gnu::always_inline]] void fetch_other(Row<Contact> row) const {
    const int other = 2 * (s.points.place(row, 1) + s.points.closest(row).unpacked().edge);
    const int own = 2 * s.points.place(row, 0);
    for (const double* list : {points, rates}) {
      if (list == nullptr) continue;
      for (const int at : {other, own}) {
        prefetch(list + at);
        prefetch(list + at + 8);
      }
    }
  }
  [[gnu::always_inline]] void operator()(const Two& two, LaneSums& sums) const {
    Projection p = start(two);
    project(*s.bodies, p);
    resolve(two, p, sums);
  }
  [[gnu::always_inline]] void operator()(const Two& a, const Two& b, LaneSums& sums) const {
    Projection of_a = start(a), of_b = start(b);
    project(*s.bodies, of_a, of_b);
    resolve(a, of_a, sums);
    resolve(b, of_b, sums);
  }

  // ---- projection
  [[gnu::always_inline]] Projection start(const Two& two) const {
    Projection p;
    p.other = {{s.columns.pair(two[0], 2), s.columns.pair(two[1], 2)},
               {s.points.place(two[0], 1), s.points.place(two[1], 1)},
               {!itself(two[0]), !itself(two[1])},
               points,
               rates};
    p.points = sampled_edges(points, two);
    if (s.images)
      move_to_images(
          two, [&](auto row) { return s.images->shift(row); }, p.points);
    p.at = CurvePoints::of(s.points.closest, two);
    p.curve = gather(p.other, points, p.at);
    return p;
  }
  [[gnu::always_inline]] PointLanes sampled_edges(const double* list, const Two& two) const {
    return edge_points_at(list + 2 * s.points.place(two[0], 0),
                          list + 2 * s.points.place(two[1], 0));
  }

  bool itself(Row<Contact> row) const {
    return s.columns.pair(row, 2) == s.columns.pair(row, 0) &&
           (!s.images || s.images->of(row) == ImageIn<TwoD>{});
  }

  [[gnu::always_inline]] PointMotion motion_at(const Two& two, const Projection& p) const {
    if (rates == nullptr) return motion_of(p, {});
    PointLanes velocity = sampled_edges(rates, two);
    if (s.images)
      move_to_images(
          two, [&](auto row) { return s.images->velocity(row); }, velocity);
    return motion_of(p, velocity);
  }

  // ---- law and sums
  [[gnu::always_inline]] void resolve(const Two& two, Projection& p, LaneSums& sums) const {
    record_projection(two, p.unconverged(), sums.block);
    PointMotion motion = motion_at(two, p);
    pass_over_bonded(s.columns, two, motion);
    const unsigned at_corners = corners.any() ? Corners::ambiguous(p, motion) : 0;
    if (at_corners != 0 && corners.settle(at_corners, p, motion)) {
      motion = motion_at(two, p);
      pass_over_bonded(s.columns, two, motion);
    }
    p.at.keep(s.points.closest, two);
    if (p.beyond != 0 && s.columns.surfaces && s.columns.surfaces->rules->reach > 0) {
      attract_to_corners(p, motion);
      pass_over_bonded(s.columns, two, motion);
    }
    const unsigned touching = find_touching(two, p, motion);
    if (touching == 0) return;
    const Lane along = act(s.columns, two, touching, motion, share, s.clock->dt_before, sums,
                           [&] { return hardness_of(two, p); });
    if (s.points.slope_load) set_slope_load(motion, along, touching, two, *s.points.slope_load);
  }
  // Folds do not indent: nothing else keeps an outline from passing through itself.
  kernels::Hardness<Lane> hardness_of(const Two& two, const Projection& p) const {
    auto hardness =
        hardness_at(*s.curves.hardness, p, {s.points.place(two[0], 0), s.points.place(two[1], 0)});
    const unsigned folds = (itself(two[0]) ? 1U : 0U) | (itself(two[1]) ? 2U : 0U);
    hardness.pressure = select(LaneMask::of(entry(lanes_of_halves, folds)),
                               Lane(kernels::no_hardness), hardness.pressure);
    return hardness;
  }
  // Those of the two candidates that touch (bit 0, bit 1); the others are set to apart.
  [[gnu::always_inline]] unsigned find_touching(const Two& two, const Projection& p,
                                                PointMotion& motion) const {
    unsigned touching = 0;
    const Lane range = range_of(s.columns, two);
    for (int i = 0; i < count_of(two); ++i) {
      const Row<Contact> row = entry(two, i);
      const bool own = itself(row);
      const double nearest = own ? nearest_fold(row, i, p, motion) : 0;
      const LaneMask near = motion.gap > -range;
      if (half_of(near.bits(), i) != 0) {
        touching |= 1U << i;
      } else {
        const Lane square = p.rx * p.rx + p.ry * p.ry;
        set_apart(s.columns, row,
                  s.clock->relative_motion +
                      (own ? nearest : std::sqrt(min_of_half(square, i)) - range[4 * i]));
      }
    }
    return touching;
  }
  double nearest_fold(Row<Contact> row, int half, const Projection& p, PointMotion& motion) const {
    const Shape& shape = s.bodies->shape_of_slot(s.columns.pair(row, 2));
    unsigned touched = 0;
    for (int g = 0; s.columns.state.touches(row) != 0 && g < edge_points; ++g)
      if (s.columns.force(row, 2 * g) != 0 || s.columns.force(row, 2 * g + 1) != 0)
        touched |= 1U << g;
    return exclude_own_body(p, half, s.columns.pair(row, 1),
                            {shape, points + 2 * s.points.place(row, 1)}, touched, motion);
  }
};

}  // namespace

void edge_contact::operator()(SmallTasks) const {
  for_active_pairs(*summed.blocks, summed.sums->blocks, EdgePass{*this});
}

}  // namespace pulvis
