#include "scenes/checks/bond_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

#include "components/bond.hpp"
#include "components/run_state.hpp"
#include "components/space/bond.hpp"
#include "engine/portable_math.hpp"
#include "scenes/language/problem.hpp"
#include "scenes/spec/dimension_words.hpp"

namespace pulvis {
namespace {

constexpr double edges_in_zone = 3;
constexpr double zone_factor = 0.88;
constexpr double largest_reach = 0.5;  // maximum that a scene may specify

std::string what_would_bond(const BondTotals::Gap& nearest, const World& world) {
  const ContactIndex* index = world.has<ContactIndex>() ? &world.resource<ContactIndex>() : nullptr;
  if (nearest.share == std::numeric_limits<double>::infinity())
    return index == nullptr
               ? "no bodies can touch each other, allowed: bodies that touch at the start"
               : fmt::format(
                     "none of their surfaces face each other within {:.4g} m, the search distance "
                     "of this `reach`, allowed: bodies that touch at the start, or a larger reach",
                     index->skin + index->reach);
  const double needed = 1.001 * nearest.share;  // must still suffice as printed
  if (needed > largest_reach)
    return fmt::format(
        "the nearest surfaces are {:.4g} m apart, {:.3g} of their edge length, allowed: bodies "
        "that touch, or a gap of at most {} of the edge length",
        nearest.width, nearest.share, largest_reach);
  return fmt::format("the nearest surfaces are {:.4g} m apart, allowed: reach >= {:.4g}",
                     nearest.width, needed);
}

// ---- length of interfaces ------------------------------------------------------------------------------
// One side's bonded edges, or faces, with one neighbour.
struct Interface {
  int edges = 0;
  double length = 0;   // m; in three dimensions, while faces are being added, m^2
  double longest = 0;  // m, longest edge
};
struct InterfaceKey {
  int law, slot, other;
  bool tool;
  auto operator<=>(const InterfaceKey&) const = default;
};
using Interfaces = std::map<InterfaceKey, Interface>;

template <class At>
void add_interfaces(const World& world, Interfaces& all) {
  if (!world.has<BondedPoints<At>>()) return;
  const auto& bodies = world.resource<Bodies>();
  const auto& pair = world.column<ContactPair<At>>();
  const auto& points = world.column<BondedPoints<At>>();
  const auto& law = world.column<BondLawNumber<At>>();
  for (std::size_t r = 0; r < pair.table.rows; ++r) {
    const unsigned bonded = points.values()[r];
    if (bonded == 0) continue;
    const std::int32_t* key = pair.values() + 3 * r;
    const Shape::Edge& edge = entry(bodies.shape_of_slot(key[0]).edges, key[1]);
    Interface& found =
        all[{law.values()[2 * r] - 1, key[0], key[2], std::is_same_v<At, ToolContact>}];
    found.edges += 1;
    found.length += edge.length * std::popcount(bonded) / edge_points;
    found.longest = std::max(found.longest, edge.length);
  }
}

// In three dimensions; the extent of an interface is that of a square with its area.
template <class At>
void add_face_interfaces(const World& world, Interfaces& all) {
  if (!world.has<space::BondedPoints<At>>()) return;
  const auto& bodies = world.resource<Bodies>();
  const auto& pair = world.column<ContactPair<At>>();
  const auto& points = world.column<space::BondedPoints<At>>();
  const auto& rules = world.resource<BondRules>();
  for (std::size_t r = 0; r < pair.table.rows; ++r) {
    const auto bonded = static_cast<unsigned>(points.values()[2 * r]);
    if (bonded == 0) continue;
    const std::int32_t* key = pair.values() + 3 * r;
    const Bodies::Slot& slot = entry(bodies.slots, key[0]);
    constexpr bool tool = std::is_same_v<At, FaceToolContact>;
    const int law = tool ? rules.initial_with_tool(key[2], slot)
                         : rules.initial_between(slot, entry(bodies.slots, key[2]));
    const auto& shape = entry(world.resource<space::Shapes>().list, slot.shape);
    const double size = entry(shape.faces, key[1]).size;
    Interface& found = all[{law - 1, key[0], key[2], tool}];
    found.edges += 1;
    found.length += size * size * std::popcount(bonded) / space::face_points;
    found.longest = std::max(found.longest, size);
  }
}

Interfaces interfaces_of(const World& world) {
  Interfaces all;
  add_interfaces<Contact>(world, all);
  add_interfaces<ToolContact>(world, all);
  Interfaces of_faces;
  add_face_interfaces<FaceContact>(world, of_faces);
  add_face_interfaces<FaceToolContact>(world, of_faces);
  for (auto& [key, found] : of_faces) {
    found.length = std::sqrt(found.length);
    all[key] = found;
  }
  return all;
}

double plane_strain_modulus(const MaterialSpec& m) {
  return m.youngs_modulus / (1 - m.poissons_ratio * m.poissons_ratio);
}

// m, for the law between the two materials; tools are rigid.
double zone_length(const Scene& scene, const BondRules::Law& law, int material, int other) {
  double modulus = plane_strain_modulus(entry(scene.materials, material));
  if (other >= 0) modulus = std::min(modulus, plane_strain_modulus(entry(scene.materials, other)));
  return zone_factor * modulus *
         std::min(law.energy / (law.strength * law.strength),
                  law.shear_energy / (law.shear_strength * law.shear_strength));
}

}  // namespace

void require_initial_bonds(const Scene& scene, const World& world) {
  if (!world.has<BondTotals>()) return;
  const auto& totals = world.resource<BondTotals>();
  std::vector<SceneProblem> problems;
  for (std::size_t i = 0; i < scene.bonds.size(); ++i) {
    const BondSpec& bond = scene.bonds[i];
    if (bond.origin != BondSpec::Origin::initial || totals.made[i] > 0) continue;
    problems.push_back(
        {scene.file_of(bond.mark).string(), bond.mark.line, bond.mark.column, "",
         fmt::format("bond[{}].reach", i),
         fmt::format("no part of '{}' and '{}' is bonded at the start: {}", bond.first, bond.second,
                     what_would_bond(totals.nearest[i], world))});
  }
  if (!problems.empty()) throw SceneError(problems);
}

namespace {

// Pairs that would be stronger than the mesh can represent get its largest strength instead.
void add_cut_strengths(const Scene& scene, const BondRules& rules,
                       std::vector<std::string>& lines) {
  constexpr double most = 0.01;
  for (std::size_t i = 0; i < rules.laws.size(); ++i) {
    const BondRules::Law& law = rules.laws[i];
    if (law.weibull_modulus == 0 || std::isinf(law.largest_share)) continue;
    const double cut = portable::exp(-portable::pow(law.largest_share, law.weibull_modulus));
    if (cut <= most) continue;
    const double wanted = portable::pow(-portable::log(most), 1 / law.weibull_modulus);
    lines.push_back(fmt::format(
        "bond[{}] between '{}' and '{}': the random strengths are cut off at {:.3g} times "
        "`strength`, which {:.2g}% of the pairs reach: a stronger bond would store more energy "
        "than its fracture energy before it breaks. With `stiffness` = {:.3g}, with edges {:.3g} "
        "times shorter, or with a fracture energy {:.3g} times higher at most {:g}% are",
        i, scene.bonds[i].first, scene.bonds[i].second, law.largest_share, 100 * cut,
        law.stiffness * wanted / law.largest_share, wanted / law.largest_share,
        wanted / law.largest_share, 100 * most));
  }
}

}  // namespace

std::vector<std::string> bond_warnings(const Scene& scene, const World& world) {
  if (!world.has<BondRules>()) return {};
  const auto& rules = world.resource<BondRules>();
  const auto& bodies = world.resource<Bodies>();
  struct Coarsest {
    double zone = 0, edge = 0;
  };
  std::map<int, Coarsest> coarse;  // by law
  for (const auto& [key, found] : interfaces_of(world)) {
    const int material = entry(bodies.slots, key.slot).material;
    const int other = key.tool ? -1 : entry(bodies.slots, key.other).material;
    const double zone = zone_length(scene, rules.law(key.law + 1), material, other);
    if (found.edges < 2 || found.length <= zone || zone >= edges_in_zone * found.longest) continue;
    Coarsest& worst = coarse[key.law];
    if (zone * worst.edge <= worst.zone * found.longest) worst = {zone, found.longest};
  }
  std::vector<std::string> lines;
  add_cut_strengths(scene, rules, lines);
  for (const auto& [law, worst] : coarse)
    lines.push_back(fmt::format(
        "bond[{}] between '{}' and '{}': the cohesive zone ahead of a crack spans {:.3g} {}, at "
        "least {} are needed to resolve it: use {} of {:.3g} m, they are up to {:.3g} m {}",
        law, entry(scene.bonds, law).first, entry(scene.bonds, law).second, worst.zone / worst.edge,
        words_of(scene).sides, edges_in_zone, words_of(scene).edges, worst.zone / edges_in_zone,
        worst.edge, words_of(scene).extent));
  return lines;
}

}  // namespace pulvis
