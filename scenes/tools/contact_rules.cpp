#include "scenes/tools/contact_rules.hpp"

#include <algorithm>

#include "scenes/tools/constraints.hpp"

namespace pulvis {

FrictionParameters friction_of(const Scene& scene, const std::string& a, const std::string& b) {
  for (const FrictionSpec& f : scene.frictions)
    if ((f.first == a && f.second == b) || (f.first == b && f.second == a)) return f;
  return {.coefficient = scene.contact.friction};
}

namespace {

bool is_adhesion(const BondSpec& bond) { return bond.origin == BondSpec::Origin::adhesion; }

}  // namespace

bool has_adhesion(const Scene& scene) { return std::ranges::any_of(scene.bonds, is_adhesion); }

AdhesionParameters adhesion_of(const Scene& scene, const std::string& a, const std::string& b) {
  for (const BondSpec& bond : scene.bonds)
    if (is_adhesion(bond) && std::minmax(bond.first, bond.second) == std::minmax(a, b))
      return {2 * bond.work / bond.range, bond.range};
  return {};
}

namespace {

SurfaceLaws laws_of(const Scene& scene, const std::string& a, const std::string& b) {
  return {friction_of(scene, a, b), adhesion_of(scene, a, b)};
}

}  // namespace

ContactRules contact_rules(const Scene& scene) {
  ContactRules rules;
  rules.stiffness = scene.contact.stiffness;
  rules.damping = scene.contact.damping;
  rules.hardness = scene.contact.hardness.value_or(0);
  rules.inertance = scene.contact.inertance;
  rules.penetration_limit = scene.limits.penetration;
  rules.unconverged_limit = scene.limits.unconverged_projections;
  rules.materials = static_cast<int>(scene.materials.size());
  for (const MaterialSpec& a : scene.materials)
    for (const MaterialSpec& b : scene.materials)
      rules.pairs.push_back(laws_of(scene, a.name, b.name));
  for (const MaterialSpec& m : scene.materials)
    rules.pairs.push_back({friction_of(scene, m.name, m.name), {}});
  for (const ToolSpec& tool : scene.tools)
    for (const MaterialSpec& m : scene.materials)
      rules.tool_pairs.push_back(is_constraint(tool) ? SurfaceLaws{}
                                                     : laws_of(scene, tool.name, m.name));
  rules.tangential = 0;
  for (const auto* list : {&rules.pairs, &rules.tool_pairs})
    for (const SurfaceLaws& of : *list) {
      rules.reach = std::max(rules.reach, of.adhesion.range);
      if (of.friction.acts())
        rules.tangential = scene.contact.tangential_stiffness.value_or(scene.contact.stiffness) /
                           scene.contact.stiffness;
    }
  return rules;
}

}  // namespace pulvis
