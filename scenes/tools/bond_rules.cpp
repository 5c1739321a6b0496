#include "scenes/tools/bond_rules.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <set>

#include "engine/entry.hpp"
#include "scenes/language/problem.hpp"
#include "scenes/spec/dimension_words.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {
namespace {

BondRules::Law law_of(const Scene& scene, const BondSpec& spec) {
  BondRules::Law law;
  if (spec.origin == BondSpec::Origin::adhesion) return law;
  law.stiffness = spec.stiffness;
  law.strength = *spec.strength;
  law.shear_strength = spec.shear_strength.value_or(*spec.strength);
  law.energy = *spec.fracture_energy;
  law.shear_energy = spec.shear_fracture_energy.value_or(*spec.fracture_energy);
  law.mixed_exponent = spec.mixed_mode_exponent;
  law.reach = spec.reach;
  law.weibull_modulus = spec.weibull_modulus.value_or(0);
  law.seed = scene.seed;
  law.threshold = spec.threshold;
  law.growth = spec.growth;
  return law;
}

std::vector<std::string> names_of_tools(const Scene& scene) {
  std::vector<std::string> names;
  for (const ToolSpec& tool : scene.tools) names.push_back(tool.name);
  return names;
}

std::uint8_t number_of(const Scene& scene, BondSpec::Origin origin, const std::string& a,
                       const std::string& b, bool inside = false) {
  for (std::size_t i = 0; i < scene.bonds.size(); ++i) {
    const BondSpec& bond = scene.bonds[i];
    if (bond.origin == origin && bond.inside == inside &&
        std::minmax(bond.first, bond.second) == std::minmax(a, b))
      return static_cast<std::uint8_t>(i + 1);
  }
  return 0;
}

}  // namespace

std::vector<SurfaceSprings> surface_springs(const Bodies& bodies) {
  std::vector<SurfaceSprings> all;
  for (const Shape& shape : bodies.shapes) {
    SurfaceSprings of{std::numeric_limits<double>::infinity(), shape.mean_edge_stiffness};
    for (const Shape::Edge& edge : shape.edges) of.softest = std::min(of.softest, edge.stiffness);
    all.push_back(of);
  }
  return all;
}

bool has_bonds(const Scene& scene) {
  return std::ranges::any_of(
      scene.bonds, [](const BondSpec& bond) { return bond.origin != BondSpec::Origin::adhesion; });
}

BondRules bond_rules(const Scene& scene) {
  using Origin = BondSpec::Origin;
  BondRules rules;
  rules.materials = static_cast<int>(scene.materials.size());
  for (const BondSpec& bond : scene.bonds) rules.laws.push_back(law_of(scene, bond));
  for (const MaterialSpec& a : scene.materials)
    for (const MaterialSpec& b : scene.materials) {
      rules.initial.push_back(number_of(scene, Origin::initial, a.name, b.name));
      rules.pressed.push_back(number_of(scene, Origin::pressed, a.name, b.name));
      const std::uint8_t inside = number_of(scene, Origin::initial, a.name, b.name, true);
      rules.inside.push_back(inside != 0 ? inside : rules.initial.back());
    }
  for (const std::string& tool : names_of_tools(scene))
    for (const MaterialSpec& m : scene.materials) {
      rules.tool_initial.push_back(number_of(scene, Origin::initial, tool, m.name));
      rules.tool_pressed.push_back(number_of(scene, Origin::pressed, tool, m.name));
    }
  return rules;
}

double longest_gap(double longest, const BondRules& rules) {
  double gap = 0;
  for (const BondRules::Law& law : rules.laws) {
    if (law.strength == 0) continue;
    const double opening =
        2 * std::max(law.energy / law.strength, law.shear_energy / law.shear_strength);
    gap = std::max(gap, law.reach * longest + opening);
  }
  return gap;
}

double stiffest_bond(const BondRules& rules, int material, bool pressed) {
  double stiffest = 0;
  const auto take = [&](const std::vector<std::uint8_t>& numbers, int at) {
    const int number = entry(numbers, at);
    if (number != 0 && rules.law(number).pressed() == pressed)
      stiffest = std::max(stiffest, rules.law(number).stiffness);
  };
  for (int other = 0; other < rules.materials; ++other)
    for (const auto* numbers : {&rules.initial, &rules.inside, &rules.pressed})
      take(*numbers, material * rules.materials + other);
  const int tools = static_cast<int>(rules.tool_initial.size()) / rules.materials;
  for (int tool = 0; tool < tools; ++tool)
    for (const auto* numbers : {&rules.tool_initial, &rules.tool_pressed})
      take(*numbers, tool * rules.materials + material);
  return stiffest;
}

void set_stiffest_bonds(const BondRules& bonds, ContactRules& rules) {
  for (int m = 0; m < bonds.materials; ++m) {
    rules.initial_stiffness.push_back(stiffest_bond(bonds, m, false));
    rules.weld_stiffness.push_back(stiffest_bond(bonds, m, true));
  }
}

namespace {

// Smallest stiffness of the contact springs of each law, Pa/m.
class SoftestSprings {
 public:
  SoftestSprings(const Bodies& bodies, const std::vector<SurfaceSprings>& of_shape,
                 const Scene& scene, const BondRules& rules)
      : of_shape_(of_shape), scene_(scene), least_(rules.laws.size(), infinite) {
    for (const Bodies::Slot& slot : bodies.slots) used_.insert({slot.shape, slot.material});
    for (const auto& [a, m] : used_)
      for (const auto& [b, n] : used_)
        for (const auto* numbers : {&rules.initial, &rules.inside, &rules.pressed})
          take(entry(*numbers, m * rules.materials + n), pair(a, m, b, n));
    const int tools = static_cast<int>(rules.tool_initial.size()) / rules.materials;
    for (const auto& [a, m] : used_)
      for (int tool = 0; tool < tools; ++tool)
        for (const auto* numbers : {&rules.tool_initial, &rules.tool_pressed})
          take(entry(*numbers, tool * rules.materials + m), softest(a, m));
  }
  double of(std::size_t law) const { return least_[law]; }
  static constexpr double infinite = std::numeric_limits<double>::infinity();

 private:
  double bulk(int material) const {
    const MaterialSpec& m = entry(scene_.materials, material);
    return m.youngs_modulus / (3 * (1 - 2 * m.poissons_ratio));
  }
  double softest(int shape, int material) const {
    return scene_.contact.stiffness * bulk(material) * entry(of_shape_, shape).softest;
  }
  // As in the broad phase: the sampled edge or face in series with the mean of the other surface.
  double pair(int a, int m, int b, int n) const {
    const double first = softest(a, m);
    const double second = scene_.contact.stiffness * bulk(n) * entry(of_shape_, b).mean;
    return first * second / (first + second);
  }
  void take(int number, double stiffness) {
    if (number == 0) return;
    double& least = entry(least_, number - 1);
    least = std::min(least, stiffness);
  }

  const std::vector<SurfaceSprings>& of_shape_;
  const Scene& scene_;
  std::set<std::pair<int, int>> used_;
  std::vector<double> least_;
};

}  // namespace

BondRules bounded_by(const Bodies& bodies, const std::vector<SurfaceSprings>& of_shape,
                     const Scene& scene, BondRules rules) {
  constexpr double margin = 1.02;  // the law must soften, however little
  const SoftestSprings springs(bodies, of_shape, scene, rules);
  std::vector<SceneProblem> problems;
  for (std::size_t i = 0; i < rules.laws.size(); ++i) {
    if (springs.of(i) == SoftestSprings::infinite) continue;  // no pair that could touch
    BondRules::Law& law = rules.laws[i];
    const double k = law.stiffness * springs.of(i);
    law.largest_share = std::numeric_limits<double>::infinity();
    const auto bound = [&](const char* key, double strength, double energy) {
      const double least = margin * strength * strength / (2 * k);
      law.largest_share = std::min(law.largest_share, energy / least);
      if (energy >= least) return;
      const SourceMark& mark = scene.bonds[i].mark;
      problems.push_back(
          {scene.file_of(mark).string(), mark.line, mark.column, "",
           fmt::format("bond[{}].{}", i, key),
           fmt::format("{:.4g} J/m^2 is less than the energy stored in the bond when it starts to "
                       "break at {:.4g} Pa, allowed: >= {:.4g} J/m^2 with this mesh; {} "
                       "or a higher `stiffness` allow less",
                       energy, strength, least, words_of(scene).finer_sides)});
    };
    bound("fracture_energy", law.strength, law.energy);
    bound("shear_fracture_energy", law.shear_strength, law.shear_energy);
  }
  if (!problems.empty()) throw SceneError(problems);
  return rules;
}

}  // namespace pulvis
