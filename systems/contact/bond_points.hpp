// Bonded points: the forces that the bonded points of two candidates carry. Shared by particle pairs and tools.
//
// Law      systems/laws/bond.hpp; in parallel with a share c of the contact law evaluated at the anchor:
//          c = d for bonds made at the start, whose spring also carries compression, (1 - d) k_n d_n (Alfano & Sacco
//          2006); c = 1 for welds, which only carry what contact does not
// Energy   stored (1 - d) w0 + c times the contact energy; dissipated: the damage energy, and what a compressed bond's
//          spring stores less what the contact that replaces it stores
// Sign     on the sampled edge along n (outward of the other surface) and t = (-n_y, n_x); the opening is the position
//          of the sampled point relative to its anchor
#pragma once

#include "components/bond.hpp"
#include "systems/contact/bond_strength.hpp"
#include "systems/contact/broad_phase.hpp"
#include "systems/contact/contact_law.hpp"

namespace pulvis {

// Positions of bonded points relative to their anchors.
struct BondMotion {
  PointMotion point;  // relative to the surface at the anchor, as for contact
  Lane along;         // m, of the sampled point relative to the anchor, along t
};

// Bonds of two candidates.
struct BondLanes {
  Lane k;                   // Pa/m, in both directions
  Lane offset_n, offset_t;  // m
  Lane strength;            // -, share
  Lane damage;              // d before the step
  LaneMask welded;          // by pressure
  Lane weight;              // m^2, in this pass: tributary area of the point, times its share
};

// Running sums of a block.
struct BondSumsOfLanes {
  using Block = BondBlock;
  Lane energy{}, contact_energy{}, fracture{}, friction_work{}, damping_work{}, area{};
  BondBlock block;

  BondBlock added_up() {
    const auto sum = [](const SumsOfHalves& s) {
      return std::array{s.a[0] + s.a[1], s.b[0] + s.b[1]};
    };
    const auto one = sum(sums_of_halves(energy, fracture));
    const auto two = sum(sums_of_halves(friction_work, damping_work));
    block.energy = one[0];
    block.fracture += one[1];
    block.friction_work = two[0];
    block.damping_work = two[1];
    const auto three = sum(sums_of_halves(area, contact_energy));
    block.area = three[0];
    block.contact_energy = three[1];
    return std::move(block);
  }
};

inline void store_points(unsigned points, const Lane& x, const Lane& y, int half, double* eight) {
  if (points == all_of_a_half)
    store_pairs_of_half(x, y, half, eight);
  else
    for (int g = 0; g < edge_points; ++g) {
      if ((points >> g & 1) == 0) continue;
      eight[2 * g] = x[half * edge_points + g];
      eight[2 * g + 1] = y[half * edge_points + g];
    }
}

// One pass over bonded rows; `share` of the stiffness and of the law used in it: one half if the other particle is
// sampled too, as in contact.
template <class At>
class BondPass {
 public:
  using Two = TwoCandidates<At>;
  using Sums = BondSumsOfLanes;
  struct Parts {
    const RowColumns<At>& rows;
    const BondColumns<At>& bonds;
    const BondRules& rules;
    const Clock& clock;
    double thickness;
    double share;
  };
  explicit BondPass(const Parts& parts) : s_(parts) {}

  // Bonded lanes. A candidate that appears twice counts once.
  unsigned bonded(const Two& two) const {
    const unsigned low = s_.bonds.points(two[0]);
    return low | (count_of(two) == 2 ? unsigned{s_.bonds.points(two[1])} << edge_points : 0U);
  }

  // `contact`: forces of the contact law at the anchors; evaluated only if any of them has a share.
  // `position` m, of the sampled points. Returns the forces on the sampled edges and the new shares.
  template <class Answer>
  PointForces act(const Two& two, unsigned bonded, const BondMotion& m, const PointLanes& position,
                  const Answer& contact, Sums& sums) const {
    const BondLanes b = lanes_of(two);
    const Lane d_n = -m.point.gap - b.offset_n, d_t = m.along - b.offset_t;
    Lane damage = b.damage;
    const Lane open = max(d_n, 0.0);
    const Lane square = b.k * b.k * fma(open, open, d_t * d_t);
    const unsigned may =
        bonded & ((b.damage > 0.0) | (square > onset_square(two) * b.strength * b.strength)).bits();
    unsigned broken = 0;
    if (may != 0) {
      const Openings openings{d_n, d_t, position};
      broken = grow(two, may, openings, b, damage, sums);
    }
    const Lane held = 1.0 - damage;
    // Compression of a weld is carried by contact alone.
    const Lane normal = select(b.welded, open, d_n);
    const Lane spring_n = b.k * normal, spring_t = b.k * d_t;
    const LaneMask lanes = LaneMask::of(bonded);
    const Lane squeezed = select(b.welded, Lane{}, min(d_n, 0.0));
    const Lane of_compression = 0.5 * b.k * squeezed * squeezed;
    const Lane contacts = select(b.welded, Lane{} + 1.0, damage);
    const Lane in_bonds = held * fma(0.5 * b.k * d_t, d_t, 0.5 * spring_n * normal) * b.weight;
    Lane pull = -(held * spring_n) * b.weight, along = -(held * spring_t) * b.weight;
    const Lane grown = damage - b.damage;
    Lane spent = grown * of_compression * b.weight;
    PointForces f;
    f.energy = f.friction_work = f.damping_work = f.elastic_slip = f.pressure = Lane{};
    if (any(lanes & (contacts > 0.0) & (m.point.gap > -range_of(s_.rows, two)))) {
      const PointForces by_contact = contact();
      const auto [push, friction] = along_axes(by_contact, m.point);
      pull = fma(contacts, push, pull);
      along = fma(contacts, friction, along);
      f.energy = contacts * by_contact.energy;
      f.friction_work = contacts * by_contact.friction_work;
      f.damping_work = contacts * by_contact.damping_work;
      f.elastic_slip = by_contact.elastic_slip;
      f.pressure = by_contact.pressure;
      spent -= select(b.welded, Lane{}, grown * by_contact.energy);
    }
    f.along = along;
    f.x = fma(pull, m.point.nx, -(along * m.point.ny));
    f.y = fma(pull, m.point.ny, along * m.point.nx);
    sums.energy += select(lanes, in_bonds, Lane{});
    add(two, bonded, f, spent, b, sums);
    keep(two, bonded, f, damage);
    if (broken != 0) release(two, broken);
    return f;
  }

 private:
  static constexpr double before_round_off = 1 - 1e-12;  // cohesive_damage decides
  struct Openings {
    const Lane &n, &t;
    const PointLanes& position;
  };

  const BondRules::Law& law(Row<At> row) const {
    return s_.rules.law(s_.bonds.law(row, BondLawNumber<At>::bonded));
  }
  double stiffness(Row<At> row) const {
    const double contact = s_.rows.law(row, ContactLaw<At>::stiffness);
    return law(row).pressed() ? law(row).stiffness * contact : contact;
  }
  BondLanes lanes_of(const Two& two) const {
    return {
        halves(stiffness(two[0]), stiffness(two[1])),
        at_points(s_.bonds.offset, two),
        at_points(s_.bonds.offset, two, edge_points),
        at_points(s_.bonds.strength, two),
        at_points(s_.bonds.damage, two),
        LaneMask::of((law(two[0]).pressed() ? 0x0fU : 0U) | (law(two[1]).pressed() ? 0xf0U : 0U)),
        s_.share * at_points(s_.rows.law, two, ContactLaw<At>::weight)};
  }
  // Square of the traction below which nothing in the candidate is damaged, at full strength. (Pa^2)
  Lane onset_square(const Two& two) const {
    const auto least = [&](Row<At> row) {
      const double weaker = std::min(law(row).strength, law(row).shear_strength);
      return before_round_off * weaker * weaker;
    };
    return halves(least(two[0]), least(two[1]));
  }

  // Grows the damage of the given points: rare, one by one. Returns those that broke.
  [[gnu::noinline]] unsigned grow(const Two& two, unsigned may, const Openings& o,
                                  const BondLanes& b, Lane& damage, Sums& sums) const {
    unsigned broken = 0;
    for (int l = 0; l < lane_count; ++l) {
      if ((may >> l & 1) == 0) continue;
      const Row<At> row = entry(two, l / edge_points);
      const auto of_point = cohesive_law(law(row), b.k[l], b.strength[l]);
      const auto now = kernels::cohesive_damage(of_point, o.n[l], o.t[l], b.damage[l]);
      damage[l] = now.d;
      sums.block.fracture += now.spent * b.weight[l];
      if (now.d < 1) continue;
      broken |= 1U << l;
      sums.block.cracks.push_back(crack(row, l, o, now.shear, b, of_point));
    }
    return broken;
  }
  Crack crack(Row<At> row, int l, const Openings& o, double shear, const BondLanes& b,
              const kernels::CohesiveLaw& of_point) const {
    const auto& pair = s_.rows.pair;
    const std::int32_t other = std::is_same_v<At, Contact> ? pair(row, 2) : -1 - pair(row, 2);
    return {.time = s_.clock.time,
            .slot = pair(row, 0),
            .edge = pair(row, 1),
            .point = l % edge_points,
            .other = other,
            .law = s_.bonds.law(row, BondLawNumber<At>::bonded),
            .x = o.position.x[l],
            .y = o.position.y[l],
            .size = b.weight[l] / s_.thickness,
            .shear = shear,
            .energy = b.weight[l] * kernels::fracture_energy(of_point, shear)};
  }

  static std::array<Lane, 2> along_axes(const PointForces& f, const PointMotion& m) {
    return {fma(f.x, m.nx, f.y * m.ny), fma(f.y, m.nx, -(f.x * m.ny))};
  }

  void add(const Two& two, unsigned bonded, const PointForces& f, const Lane& spent,
           const BondLanes& b, Sums& sums) const {
    const LaneMask lanes = LaneMask::of(bonded);
    sums.contact_energy += select(lanes, f.energy, Lane{});
    sums.fracture += select(lanes, spent, Lane{});
    sums.friction_work += select(lanes, f.friction_work, Lane{});
    sums.damping_work += select(lanes, f.damping_work, Lane{});
    sums.area += select(lanes, b.weight, Lane{});
    for (int half = 0; half < count_of(two); ++half)
      sums.block.rows += half_of(bonded, half) == BondedPoints<At>::all ? 1 : 0;
  }
  // Bonded points only: the narrow phase has handled the others.
  void keep(const Two& two, unsigned bonded, const PointForces& f, const Lane& damage) const {
    for (int half = 0; half < count_of(two); ++half) {
      const Row<At> row = entry(two, half);
      const unsigned points = half_of(bonded, half);
      s_.rows.state.touches(row) = 1;
      store_points(points, f.x, f.y, half, &s_.rows.force(row));
      if (points == BondedPoints<At>::all)
        s_.rows.state.activation(row) = back_face;  // nothing left for the narrow phase
      store_points(points, damage, half, &s_.bonds.damage(row));
      if (s_.rows.sliding)
        store_points(points, f.elastic_slip, half, &s_.rows.sliding->elastic_slip(row));
      if (s_.rows.bonding->weld)
        store_points(points, (1 / s_.share) * f.pressure, half, &(*s_.rows.bonding->weld)(row));
    }
  }
  // From the next step on, the narrow phase handles the contact of broken points.
  void release(const Two& two, unsigned broken) const {
    for (int half = 0; half < count_of(two); ++half) {
      const Row<At> row = entry(two, half);
      const unsigned points = half_of(broken, half);
      if (points == 0) continue;
      s_.bonds.points(row) = static_cast<std::uint8_t>(s_.bonds.points(row) & ~points);
      s_.rows.state.activation(row) = 0;
      for (int g = 0; g < edge_points; ++g) {
        if ((points >> g & 1) == 0) continue;
        s_.bonds.damage(row, g) = 0;
        if (!s_.rows.bonding->weld) continue;
        const auto& pressure = *s_.rows.bonding->weld;
        // The one now is that at the anchor: no measure of what the contact has carried.
        pressure(row, g) = pressure(row, WeldPressure<At>::largest + g) = 0;
      }
    }
  }

  const Parts s_;
};

}  // namespace pulvis
