// Bonds of eight contact points of a row against one other body: forces until they break, and welding by pressure.
// Shared by pairs of particles and tools.
//
// Law      systems/laws/bond.hpp, at the place d = x_s - x_a of the sampled point from the point x_a of the other surface
//          that holds it, n the normal there, d_n = d . n less the opening when the bond was made, d_t = d - (d . n) n;
//          in parallel with a share c of the contact law at x_a:
//          c = d for bonds made at the start, whose spring also carries compression, (1 - d) k_n d_n (Alfano & Sacco
//          2006), and contact counts from an initial overlap on; c = 1 for welds, which only carry what contact does not
// Energy   stored (1 - d) w0 + c times the contact energy; dissipated: the damage energy, and what a compressed bond's
//          spring stores less what the contact that replaces it stores
// Sign     force on the sampled face
#pragma once

#include <algorithm>
#include <array>
#include <bit>

#include "components/space/bond.hpp"
#include "systems/contact/bond_strength.hpp"
#include "systems/space/contact/contact_law.hpp"
#include "systems/space/contact/systems.hpp"

namespace pulvis::space {

// Where the points of eight lanes are in the columns.
struct PlacesInRows {
  std::array<std::int32_t, lane_count> row, point;
};

// The sums of a block while it is processed.
struct BondSumsOfBlock {
  Lane energy{}, fracture{}, area{};
  BondBlock block;

  BondBlock added_up() {
    block.energy = FaceSums::sum(energy);
    block.fracture += FaceSums::sum(fracture);
    block.area = FaceSums::sum(area);
    return std::move(block);
  }
};

// Motion of a bonded point relative to the place that holds it. What the surface's rotation alone makes of it does not
// count as slip.
inline PointMotion held_motion(PointMotion m, const VectorLanes& along) {
  const VectorLanes carried = cross(m.spin, along);
  const Lane normal = dot(carried, m.normal);
  m.gap_rate += normal;
  m.slip = m.slip - fma(-normal, m.normal, carried);
  return m;
}

// The bonds of one row's points, or of a pair's. `share` of the stiffness and of the law used in a pass: one half if the
// other particle is sampled too, as in contact.
template <class At>
class PointBonds {
 public:
  struct Between {
    int initial, pressed;  // numbers in BondRules, 0: none
    std::int32_t slot;     // sampled particle
    std::int32_t other;    // slot; for a tool -1 - its number
  };
  PointBonds(const BondColumns<At>& columns, double time, const Between& of, double share,
             BondSumsOfBlock& sums)
      : s_(columns), time_(time), of_(of), share_(share), sums_(sums) {}

  unsigned bonded(Row<At> row) const {
    return static_cast<unsigned>(s_.points(row, BondedPoints<At>::all));
  }
  // m, < 0: by how much the given points overlapped when they were bonded; contact counts from there. `gap`: m, of these
  // points, of which the bonded ones are given. Of the others, those that have parted lose it.
  Lane overlap(const PlacesInRows& at, unsigned lanes, unsigned bonded, const Lane& gap) const {
    Lane overlap{};
    if (!s_.offset) return overlap;
    for (unsigned left = lanes; left != 0; left &= left - 1) {
      const int l = std::countr_zero(left);
      double& offset = (*s_.offset)(Row<At>(entry(at.row, l)), entry(at.point, l));
      if (gap[l] <= 0 && (bonded >> l & 1) == 0) offset = 0;
      overlap[l] = std::min(offset, 0.0);
    }
    return overlap;
  }
  bool may_weld() const { return of_.pressed != 0 && s_.weld; }

  // Adds to the contact forces `f`, of which a share remains, what the bonded lanes hold. `law`: that of contact; `m`: its
  // motion, from an initial overlap on.
  struct Holding {
    const PlacesInRows& at;
    unsigned bonded;
    const std::array<std::int32_t, lane_count>& face;  // number of the sampled face
    const VectorLanes& position;                       // m, of the sampled points
    const VectorLanes& along;                          // m, d_t
  };
  void hold(const Holding& h, const PointLaw& law, const PointMotion& m, PointForces& f) const {
    const LaneMask lanes = LaneMask::of(h.bonded);
    const Bonds b = bonds_of(h, law);
    const Lane opening = -m.depth() - max(b.offset, 0.0), slide2 = dot(h.along, h.along);
    const Lane open = max(opening, 0.0);
    const Lane tension2 = b.k * b.k * fma(open, open, slide2);
    const unsigned may =
        h.bonded &
        ((b.damage > 0.0) | (tension2 > onset_square(b) * b.strength * b.strength)).bits();
    Lane damage = b.damage;
    unsigned broken = 0;
    if (may != 0) broken = grow(h, may, b, {opening, sqrt(slide2)}, damage);
    const LaneMask welded = LaneMask::of(b.welded);
    const Lane intact = 1.0 - damage, grown = damage - b.damage;
    // Compression of a weld is carried by contact alone.
    const Lane normal = select(welded, open, opening);
    const Lane contacts = select(lanes, select(welded, Lane(1.0), damage), Lane(1.0));
    const Lane squeezed = select(welded, Lane{}, min(opening, 0.0));
    const Lane spent =
        fma(0.5 * b.k * squeezed * squeezed, b.weight, -select(welded, Lane{}, f.energy));
    take_share(contacts, f);
    const Lane pull = select(lanes, -(intact * b.k * b.weight), Lane{});
    f.force = f.force + pull * fma(normal, m.normal, h.along);
    sums_.energy +=
        select(lanes, 0.5 * intact * b.k * b.weight * fma(normal, normal, slide2), Lane{});
    sums_.fracture += select(lanes, grown * spent, Lane{});
    sums_.area += select(lanes, b.weight, Lane{});
    keep(h, may, damage);
    if (broken != 0) release(h, broken);
  }

  // Tracks the pressure of the given lanes, welds those whose pressure has dropped, and strengthens existing welds.
  // `pressure`: Pa, of this pass. Returns the new welds.
  [[gnu::noinline]] unsigned press(const PlacesInRows& at, unsigned lanes,
                                   const Lane& pressure) const {
    const BondRules::Law& law = s_.rules->law(of_.pressed);
    unsigned made = 0;
    for (unsigned left = lanes; left != 0; left &= left - 1) {
      const int l = std::countr_zero(left);
      const Row<At> row(entry(at.row, l));
      const int g = entry(at.point, l);
      const bool held = (bonded(row) >> g & 1) != 0;
      if (held && !is_weld(row, g)) continue;
      const double now = pressure[l] / share_;
      double& largest = (*s_.weld)(row, g);
      largest = std::max(largest, now);
      if (largest <= law.threshold) continue;
      const double strength = welded_strength(law, largest);
      if (held) {
        s_.strength(row, g) = std::max(s_.strength(row, g), strength);
      } else if (now < weld_at * largest) {
        s_.points(row, BondedPoints<At>::all) |= 1 << g;
        s_.points(row, BondedPoints<At>::welds) |= 1 << g;
        s_.strength(row, g) = strength;
        made |= 1U << l;
      }
    }
    return made;
  }

 private:
  static constexpr double before_round_off = 1 - 1e-12;  // cohesive_damage decides

  struct Bonds {
    Lane k;                         // Pa/m, in all directions
    Lane offset, strength, damage;  // before the step
    unsigned welded;
    Lane weight;  // m^2, in this pass
  };
  struct Openings {
    Lane normal, slide;  // m
  };

  bool is_weld(Row<At> row, int g) const {
    return (s_.points(row, BondedPoints<At>::welds) >> g & 1) != 0;
  }
  int law_number(bool weld) const { return weld ? of_.pressed : of_.initial; }

  Bonds bonds_of(const Holding& h, const PointLaw& law) const {
    Bonds b{Lane{}, Lane{}, Lane(1.0), Lane{}, 0, share_ * law.weight};
    for (unsigned left = h.bonded; left != 0; left &= left - 1) {
      const int l = std::countr_zero(left);
      const Row<At> row(entry(h.at.row, l));
      const int g = entry(h.at.point, l);
      b.strength[l] = s_.strength(row, g);
      b.damage[l] = s_.damage(row, g);
      if (is_weld(row, g))
        b.welded |= 1U << l;
      else
        b.offset[l] = (*s_.offset)(row, g);
    }
    // Contact springs of bonds made at the start are as stiff as these.
    const double of_weld = of_.pressed == 0 ? 1 : s_.rules->law(of_.pressed).stiffness;
    b.k = (1 / share_) * law.kappa * select(LaneMask::of(b.welded), Lane(of_weld), Lane(1.0));
    return b;
  }
  // Square of the traction below which nothing is damaged, at full strength. (Pa^2)
  Lane onset_square(const Bonds& b) const {
    const auto least = [&](int number) {
      if (number == 0) return 0.0;
      const BondRules::Law& law = s_.rules->law(number);
      const double weaker = std::min(law.strength, law.shear_strength);
      return before_round_off * weaker * weaker;
    };
    return select(LaneMask::of(b.welded), Lane(least(of_.pressed)), Lane(least(of_.initial)));
  }

  // Grows the damage of the given lanes: rare, one by one. Returns those that broke.
  [[gnu::noinline]] unsigned grow(const Holding& h, unsigned may, const Bonds& b, const Openings& o,
                                  Lane& damage) const {
    unsigned broken = 0;
    for (unsigned left = may; left != 0; left &= left - 1) {
      const int l = std::countr_zero(left);
      const int number = law_number((b.welded >> l & 1) != 0);
      const auto law = cohesive_law(s_.rules->law(number), b.k[l], b.strength[l]);
      const auto now = pulvis::kernels::cohesive_damage(law, o.normal[l], o.slide[l], b.damage[l]);
      damage[l] = now.d;
      sums_.block.fracture += now.spent * b.weight[l];
      if (now.d < 1) continue;
      broken |= 1U << l;
      sums_.block.cracks.push_back(
          {.time = time_,
           .slot = of_.slot,
           .edge = entry(h.face, l),
           .point = entry(h.at.point, l),
           .other = of_.other,
           .law = number,
           .x = h.position.x[l],
           .y = h.position.y[l],
           .z = h.position.z[l],
           .size = b.weight[l],
           .shear = now.shear,
           .energy = b.weight[l] * pulvis::kernels::fracture_energy(law, now.shear)});
    }
    return broken;
  }

  static void take_share(const Lane& share, PointForces& f) {
    f.force = share * f.force;
    f.friction = share * f.friction;
    f.energy = share * f.energy;
    f.friction_work = share * f.friction_work;
    f.damping_work = share * f.damping_work;
    f.indentation_work = share * f.indentation_work;
  }
  void keep(const Holding& h, unsigned lanes, const Lane& damage) const {
    for (unsigned left = lanes; left != 0; left &= left - 1) {
      const int l = std::countr_zero(left);
      s_.damage(Row<At>(entry(h.at.row, l)), entry(h.at.point, l)) = damage[l];
    }
  }
  // From the next step on the points are in contact only.
  void release(const Holding& h, unsigned broken) const {
    for (unsigned left = broken; left != 0; left &= left - 1) {
      const int l = std::countr_zero(left);
      const Row<At> row(entry(h.at.row, l));
      const int g = entry(h.at.point, l);
      for (const auto bits : {BondedPoints<At>::all, BondedPoints<At>::welds})
        s_.points(row, bits) &= ~(1 << g);
      s_.damage(row, g) = 0;
      if (s_.offset) (*s_.offset)(row, g) = std::min((*s_.offset)(row, g), 0.0);
      if (s_.weld) (*s_.weld)(row, g) = 0;
    }
  }

  const BondColumns<At>& s_;
  double time_;
  Between of_;
  double share_;
  BondSumsOfBlock& sums_;
};

}  // namespace pulvis::space
