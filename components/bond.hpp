// Columns of bonds: contact points that stick together until they break. A bonded point is anchored to a material point
// of the other surface; while it is bonded, the `bonds` system handles it and the narrow phase skips it.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include "components/contact.hpp"
#include "components/shape.hpp"
#include "engine/entry.hpp"

namespace pulvis {

// ---- contact rows, only if the scene has bonds -----------------------------------------------------
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
struct BondDamage : Component<At, double, At::points> {
  static constexpr ComponentInfo info{"bond_damage", "-", "d, 0 ... 1: history"};
};
template <class At>
struct BondStrength : Component<At, double, At::points> {
  static constexpr ComponentInfo info{"bond_strength", "-", "share of the law's strengths"};
};
// Only if bonds form under pressure.
template <class At>
struct WeldPressure : Component<At, double, 2 * edge_points> {
  static constexpr ComponentInfo info{
      "weld_pressure", "Pa", "contact pressure of every point now, then its largest so far"};
  static constexpr int largest = edge_points;  // index of the first maximum
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
// Bond settings of the scene; laws are numbered from 1, 0 means none.
struct BondRules {
  static constexpr const char* resource_name = "bond_rules";
  static constexpr bool fixed = true;
  struct Law {
    double stiffness = 0;        // -, ratio of bond stiffness to contact stiffness
    double strength = 0;         // Pa, sigma_c
    double shear_strength = 0;   // Pa, tau_c
    double energy = 0;           // J/m^2, G_I
    double shear_energy = 0;     // J/m^2, G_II
    double mixed_exponent = 2;   // -, eta of Benzeggagh and Kenane
    double largest_share = 1;    // -, upper limit of a random strength, over `strength`
    double reach = 0;            // -, of the edge length: closer surfaces are bonded at the start
    double weibull_modulus = 0;  // -, of the strengths of particle pairs; 0: all alike
    std::uint64_t seed = 0;
    double threshold = 0;  // Pa, pressure above which a weld forms
    double growth = 0;     // -, strength gained per pressure above that; 0: bonded at the start
    bool pressed() const { return growth > 0; }
  };
  std::vector<Law> laws;
  int materials = 0;
  std::vector<std::uint8_t> initial, pressed;  // [materials * materials]
  std::vector<std::uint8_t> inside;            // likewise, initial, for grains of one particle
  std::vector<std::uint8_t> tool_initial, tool_pressed;  // [tools * materials]

  const Law& law(int number) const { return entry(laws, number - 1); }
  static bool any(const std::vector<std::uint8_t>& numbers) {
    return std::ranges::any_of(numbers, [](std::uint8_t number) { return number != 0; });
  }
  // -, contact stiffness of surfaces that may be bonded initially: as stiff as the bond, so that a bond breaking under
  // pressure hands its load over to the contact.
  double contact_stiffness(int initial_law) const {
    return initial_law == 0 ? 1 : law(initial_law).stiffness;
  }
  int initial_between(const Bodies::Slot& a, const Bodies::Slot& b) const {
    return entry(a.parent == b.parent ? inside : initial, a.material * materials + b.material);
  }
  std::uint8_t pressed_between(const Bodies::Slot& a, const Bodies::Slot& b) const {
    return entry(pressed, a.material * materials + b.material);
  }
  std::uint8_t pressed_with_tool(int tool, const Bodies::Slot& a) const {
    return entry(tool_pressed, tool * materials + a.material);
  }
  int initial_with_tool(int tool, const Bodies::Slot& a) const {
    return entry(tool_initial, tool * materials + a.material);
  }
};

// ---- results -----------------------------------------------------------------------------------------
// A broken point.
struct Crack {
  double time = 0;        // s
  std::int32_t slot = 0;  // of the sampled particle; then its edge or face, and Gauss point
  std::int32_t edge = 0;
  std::int32_t point = 0;
  std::int32_t other = 0;  // slot; for a tool -1 - its number
  std::int32_t law = 0;    // numbered as in BondRules
  double x = 0, y = 0;     // m, location; with z in three dimensions
  double z = 0;
  // m (in three dimensions m^2), half the length (area) of the point: the other side is sampled too. All of it for tools.
  double size = 0;
  double shear = 0;   // -, shear share of the energy at failure: 0 mode I, 1 mode II
  double energy = 0;  // J, fracture energy of the law in that mode, times the area of the point

  template <class Bytes>
  void state(Bytes& bytes) {
    bytes(time, slot, edge, point, other, law, x, y, z, size, shear, energy);
  }
};

// Sums over a block of rows, as in the narrow phase.
struct alignas(64) BondBlock {
  double energy = 0;          // J, stored in bonds
  double contact_energy = 0;  // J, stored in contact springs of bonded points
  double fracture = 0;        // J, dissipated by damage in the last step
  double friction_work = 0;   // J, in the last step, at partly damaged or welded points
  double damping_work = 0;    // J
  double area = 0;            // m^2, bonded, on the sampled side
  std::int32_t rows = 0;      // with bonded points only
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
  double fracture = 0;             // J, dissipated by damage
  double area = 0;                 // m^2, bonded now, mean of both sides
  double crack_size = 0;           // m, broken; in three dimensions m^2
  std::vector<std::int32_t> made;  // [laws] points bonded at the start
  struct Gap {
    double width = std::numeric_limits<double>::infinity();  // m
    double share = std::numeric_limits<double>::infinity();  // -, of the boundary edge
    // Independent of the order of calls.
    void take(double gap, double length) { take({gap, gap / length}); }
    void take(const Gap& other) {
      if (other.share < share || (other.share == share && other.width < width)) *this = other;
    }
  };
  std::vector<Gap> nearest;   // [laws] between facing surfaces; searched anew at every start
  std::vector<Crack> cracks;  // in order of occurrence

  template <class Bytes>
  void state(Bytes& bytes) {
    bytes(energy, fracture, area, crack_size, made, cracks);
  }
};

// Fragments as last observed: particles joined by at least one bonded point form one fragment.
struct Fragments {
  static constexpr const char* resource_name = "fragments";
  // [particles], by number: the lowest particle number in the same fragment. Kept even after parts have broken off.
  std::vector<std::int32_t> of_particle;
  std::vector<std::int64_t> points;  // [laws], bonded now
  // m (in three dimensions m^2), [particles], size of the bonds made at the start: intact, and broken. Both sides are
  // sampled: half each.
  std::vector<double> bonded, broken;
  std::int64_t counted = 0;  // cracks already included in `broken`

  void restart(int particles, std::size_t laws) {
    bonded.assign(static_cast<std::size_t>(particles), 0);
    broken.resize(static_cast<std::size_t>(particles), 0);
    points.assign(laws, 0);
  }
  template <class Bytes>
  void state(Bytes& bytes) {
    bytes(of_particle, points, bonded, broken, counted);
  }
};

}  // namespace pulvis
