// bond_forces: forces of bonded points between particles, until they break.
//
// Law      systems/contact/bond_points.hpp; the frame is that of the other curve at the anchor. Because it rotates
//          with the curve, the slope carries a load, so that forces are the derivative of the stored energy
// Runs     after edge_contact and pressed_bonds, before contact_force, and before contacts are sent to other ranks
// Active   when the scene has bonds between particles
#include "engine/prefetch.hpp"
#include "systems/contact/active_pairs.hpp"
#include "systems/contact/bond_points.hpp"
#include "systems/contact/projection.hpp"
#include "systems/contact/systems.hpp"

namespace pulvis {
namespace {

using Two = TwoCandidates<Contact>;

struct PairBonds {
  using Sums = BondSumsOfLanes;
  static constexpr double share = 0.5;  // the other particle is sampled too
  const bond_forces& s;
  const BondPass<Contact> bonds{
      {s.columns, s.bonds, *s.rules, *s.clock, s.bodies->thickness, share}};
  const double* points = s.curves.position.values().data();
  const double* rates = s.curves.velocity ? s.curves.velocity->values().data() : nullptr;

  // ---- active rows
  bool active(Row<Contact> row) const { return s.bonds.points(row) != 0; }
  void fetch(Row<Contact> row) const {
    pulvis::fetch(s.columns, row);
    prefetch(&s.at.place(row));
    prefetch(&s.at.anchor(row));
    prefetch(&s.bonds.offset(row));
    prefetch(&s.bonds.damage(row));
    prefetch(&s.bonds.strength(row));
    prefetch(&s.at.slope_load(row));
  }
  void fetch_other(Row<Contact> row) const {
    prefetch(points + 2 * (s.at.place(row, 1) + s.at.anchor(row).unpacked().edge));
    prefetch(points + 2 * s.at.place(row, 0));
  }

  [[gnu::flatten]] void operator()(const Two& two, Sums& sums) const {
    Projection p = at_anchors(two);
    const BondMotion m = motion(p);
    const unsigned bonded = bonds.bonded(two);
    const auto contact = [&] {
      p.other.velocity = rates;
      const PointMotion moving = rates == nullptr ? m.point : motion_of(p, sampled_rates(two));
      return forces_of_bonded(s.columns, two, moving, share, s.clock->dt_before);
    };
    const PointForces f = bonds.act(two, bonded, m, p.points, contact, sums);
    set_slope_load(two, bonded, f, m);
    keep_anchors(two, bonded);
  }

 private:
  PointLanes sampled_edges(const double* list, const Two& two) const {
    return edge_points_at(list + 2 * s.at.place(two[0], 0), list + 2 * s.at.place(two[1], 0));
  }
  PointLanes sampled_rates(const Two& two) const {
    PointLanes velocity = sampled_edges(rates, two);
    if (s.at.images)
      move_to_images(
          two, [&](auto row) { return s.at.images->velocity(row); }, velocity);
    return velocity;
  }
  Projection at_anchors(const Two& two) const {
    Projection p;
    p.other = {{s.columns.pair(two[0], 2), s.columns.pair(two[1], 2)},
               {s.at.place(two[0], 1), s.at.place(two[1], 1)},
               {},
               points,
               nullptr};
    p.points = sampled_edges(points, two);
    if (s.at.images)
      move_to_images(
          two, [&](auto row) { return s.at.images->shift(row); }, p.points);
    p.at = CurvePoints::of(s.at.anchor, two);
    p.curve = gather(p.other, points, p.at);
    p.offset();
    return p;
  }
  static BondMotion motion(const Projection& p) {
    const PointMotion m = motion_of(p, {});
    return {m, fma(p.ry, m.nx, -(p.rx * m.ny))};
  }
  // On the other curve's slope: the torque of forces whose points are separated by an opening, over |x'|.
  void set_slope_load(const Two& two, unsigned bonded, const PointForces& f,
                      const BondMotion& m) const {
    const Lane push = fma(f.x, m.point.nx, f.y * m.point.ny);
    const Lane size = fma(push, m.along, f.along * m.point.gap) * m.point.inv_slope;
    const Lane x = size * m.point.nx, y = size * m.point.ny;
    for (int half = 0; half < count_of(two); ++half)
      store_points(half_of(bonded, half), x, y, half, &s.at.slope_load(entry(two, half)));
  }
  // Where their forces act on the other body, and where the closest-point search starts once they break.
  void keep_anchors(const Two& two, unsigned bonded) const {
    for (int half = 0; half < count_of(two); ++half) {
      const Row<Contact> row = entry(two, half);
      for (int g = 0; g < edge_points; ++g)
        if ((half_of(bonded, half) >> g & 1) != 0) s.at.closest(row, g) = s.at.anchor(row, g);
    }
  }
};

}  // namespace

void bond_forces::operator()(SmallTasks) const {
  for_active_pairs(*summed.blocks, summed.sums->blocks, PairBonds{*this});
}

}  // namespace pulvis
