// Columns of bonds: contact points that hold together until they break. A bonded point is anchored to a material point
// of the other surface; while it is bonded, `bonds` answers for it and the narrow phase passes over it.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "components/contact.hpp"
#include "components/shape.hpp"
#include "engine/entry.hpp"

namespace pulvis {

// ---- candidates, only where the scene has bonds ----------------------------------------------------
template <class At>
struct BondLawNumber : Component<At, std::uint8_t, 2> {
  static constexpr ComponentInfo info{"bond_law", "-",
                                      "of its bonded points; by which pressure would weld it: 1 + "
                                      "position in BondRules::laws, or 0"};
  enum Number { bonded, weld };
};
template <class At>
struct BondedPoints : Component<At, std::uint8_t, 1> {
  static constexpr ComponentInfo info{"bonded", "-", "bit g: Gauss point g is bonded"};
  static constexpr std::uint8_t all = (1U << edge_points) - 1;
};
template <class At>
struct BondOffset : Component<At, double, 2 * edge_points> {
  static constexpr ComponentInfo info{
      "bond_offset", "m",
      "opening when the bond was made: of every point along the normal, then along the surface"};
};
template <class At>
struct BondDamage : Component<At, double, edge_points> {
  static constexpr ComponentInfo info{"bond_damage", "-", "d, 0 ... 1: history"};
};
template <class At>
struct BondStrength : Component<At, double, edge_points> {
  static constexpr ComponentInfo info{"bond_strength", "-", "share of the law's strengths"};
};
// Only where pressure makes bonds.
template <class At>
struct WeldPressure : Component<At, double, 2 * edge_points> {
  static constexpr ComponentInfo info{
      "weld_pressure", "Pa", "contact pressure of every point now, then its largest so far"};
  static constexpr int largest = edge_points;  // the first of those
};

struct CurveAnchor : Component<Contact, PackedCurvePoint, edge_points> {
  static constexpr ComponentInfo info{
      "anchor", "-", "material point of the other outline, as closest_point counts"};
};
struct ToolAnchor : Component<ToolContact, double, 4 * edge_points> {
  static constexpr ComponentInfo info{
      "anchor", "SI", "of every point: x y of the bonded point from the tool's [m], its normal"};
};

// ---- rules ---------------------------------------------------------------------------------------
// What the scene says of bonds; laws are numbered from 1, 0 is none.
struct BondRules {
  static constexpr const char* resource_name = "bond_rules";
  static constexpr bool fixed = true;
  struct Law {
    double stiffness = 0;        // -, of the bond over that of the contact spring
    double strength = 0;         // Pa, sigma_c
    double shear_strength = 0;   // Pa, tau_c
    double energy = 0;           // J/m^2, G_I
    double shear_energy = 0;     // J/m^2, G_II
    double mixed_exponent = 2;   // -, eta of Benzeggagh and Kenane
    double largest_share = 1;    // -, of the strength that a draw may give
    double reach = 0;            // -, of the edge length: nearer surfaces are bonded at the start
    double weibull_modulus = 0;  // -, of the strengths of neighbours; 0: all alike
    std::uint64_t seed = 0;
    double threshold = 0;  // Pa, pressure from which on it welds
    double growth = 0;     // -, strength gained a pressure beyond that; 0: it is made at the start
    bool pressed() const { return growth > 0; }
  };
  std::vector<Law> laws;
  int materials = 0;
  std::vector<std::uint8_t> initial, pressed;  // [materials * materials]
  std::vector<std::uint8_t> inside;            // likewise, initial between grains of one particle
  std::vector<std::uint8_t> tool_initial, tool_pressed;  // [tools * materials]

  const Law& law(int number) const { return entry(laws, number - 1); }
  // -, of the contact spring of surfaces that may have been bonded at the start: as stiff as the bond, so that one which
  // breaks under pressure leaves its load to the contact.
  double contact_stiffness(int initial_law) const {
    return initial_law == 0 ? 1 : law(initial_law).stiffness;
  }
  int initial_between(const Bodies::Slot& a, const Bodies::Slot& b) const {
    return entry(a.parent == b.parent ? inside : initial, a.material * materials + b.material);
  }
  int initial_with_tool(int tool, const Bodies::Slot& a) const {
    return entry(tool_initial, tool * materials + a.material);
  }
};

// ---- what came of them -------------------------------------------------------------------------------
// A point that broke.
struct Crack {
  double time = 0;        // s
  std::int32_t slot = 0;  // that samples, its edge, and which Gauss point of it
  std::int32_t edge = 0;
  std::int32_t point = 0;
  std::int32_t other = 0;  // slot; of a tool -1 - its number
  std::int32_t law = 0;    // as BondRules counts
  double x = 0, y = 0;     // m, where
  double length = 0;       // m, half of what the point stands for: the other side samples too
  double shear = 0;        // -, share of shear in the energy when it broke: 0 mode I, 1 mode II
  double energy = 0;       // J, spent in breaking it, from its first damage on

  template <class Bytes>
  void state(Bytes& bytes) {
    bytes(time, slot, edge, point, other, law, x, y, length, shear, energy);
  }
};

// Of a block of rows, as of the narrow phase.
struct alignas(64) BondBlock {
  double energy = 0;          // J, stored in bonds
  double contact_energy = 0;  // J, stored in contact springs of bonded points
  double fracture = 0;        // J, spent by damage in the last step
  double friction_work = 0;   // J, in the last step, at points partly damaged or welded
  double damping_work = 0;    // J
  double area = 0;            // m^2, bonded, of its own side
  std::int32_t rows = 0;      // with nothing but bonded points
  std::vector<Crack> cracks;

  template <class Bytes>
  void state(Bytes& bytes) {
    bytes(energy, contact_energy, fracture, friction_work, damping_work, area, rows, cracks);
  }
};
template <class At>
struct BondSums {
  static constexpr const char* resource_name =
      std::is_same_v<At, Contact> ? "bond_sums" : "tool_bond_sums";
  std::vector<BondBlock> blocks;

  template <class Bytes>
  void state(Bytes& bytes) {
    bytes(blocks);
  }
};

struct BondTotals {
  static constexpr const char* resource_name = "bond_totals";
  double energy = 0;               // J, stored now
  double fracture = 0;             // J, spent by damage
  double area = 0;                 // m^2, bonded now, the mean of both sides
  double crack_length = 0;         // m, broken
  std::vector<std::int32_t> made;  // [laws] points bonded at the start
  struct Gap {
    double width = std::numeric_limits<double>::infinity();  // m
    double share = std::numeric_limits<double>::infinity();  // -, of the boundary edge
    // The same of any order.
    void take(double gap, double length) { take({gap, gap / length}); }
    void take(const Gap& other) {
      if (other.share < share || (other.share == share && other.width < width)) *this = other;
    }
  };
  std::vector<Gap> nearest;   // [laws] surfaces that face each other; found anew at every start
  std::vector<Crack> cracks;  // in the order in which they came

  template <class Bytes>
  void state(Bytes& bytes) {
    bytes(energy, fracture, area, crack_length, made, cracks);
  }
};

// What holds together, as last observed: particles joined by at least one bonded point make a fragment.
struct Fragments {
  static constexpr const char* resource_name = "fragments";
  // [particles], by number: the lowest number of a particle of the same fragment. It outlives what breaks off.
  std::vector<std::int32_t> of_particle;
  std::vector<std::int64_t> points;  // [laws], bonded now
  // m, [particles], of the bonds made at the start: what holds, and what broke. Both sides sample: half each.
  std::vector<double> bonded, broken;
  std::int64_t counted = 0;  // cracks that `broken` holds

  template <class Bytes>
  void state(Bytes& bytes) {
    bytes(of_particle, points, bonded, broken, counted);
  }
};

}  // namespace pulvis
