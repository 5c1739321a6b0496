#include "scenes/tools/contact_rules.hpp"

#include <algorithm>

#include "scenes/tools/constraints.hpp"

namespace pulvis {

ContactRules::Friction friction_of(const Scene& scene, const std::string& a, const std::string& b) {
  for (const FrictionSpec& f : scene.frictions) {
    if (!((f.first == a && f.second == b) || (f.first == b && f.second == a))) continue;
    ContactRules::Friction friction{.coefficient = f.coefficient};
    if (f.static_coefficient) {
      friction.drop = *f.static_coefficient - f.coefficient;
      friction.inv_decay = 1 / *f.decay_length;
    }
    if (f.shear_strength) friction.strength = *f.shear_strength;
    if (f.rate) {
      friction.rate = *f.rate;
      friction.inv_speed = 1 / *f.reference_speed;
    }
    return friction;
  }
  return {.coefficient = scene.contact.friction};
}

namespace {

bool is_adhesion(const BondSpec& bond) { return bond.origin == BondSpec::Origin::adhesion; }

}  // namespace

bool has_adhesion(const Scene& scene) { return std::ranges::any_of(scene.bonds, is_adhesion); }

ContactRules::Adhesion adhesion_of(const Scene& scene, const std::string& a, const std::string& b) {
  for (const BondSpec& bond : scene.bonds)
    if (is_adhesion(bond) && std::minmax(bond.first, bond.second) == std::minmax(a, b))
      return {2 * bond.work / bond.range, bond.range};
  return {};
}

namespace {

void add_adhesion(const Scene& scene, ContactRules& rules) {
  for (const MaterialSpec& a : scene.materials)
    for (const MaterialSpec& b : scene.materials)
      rules.adhesion.push_back(adhesion_of(scene, a.name, b.name));
  for (const ToolSpec& tool : scene.tools)
    for (const MaterialSpec& m : scene.materials)
      rules.tool_adhesion.push_back(adhesion_of(scene, tool.name, m.name));
}

}  // namespace

ContactRules contact_rules(const Scene& scene) {
  ContactRules rules;
  rules.stiffness = scene.contact.stiffness;
  rules.damping = scene.contact.damping;
  rules.penetration_limit = scene.limits.penetration;
  rules.unconverged_limit = scene.limits.unconverged_projections;
  rules.materials = static_cast<int>(scene.materials.size());
  for (const MaterialSpec& a : scene.materials)
    for (const MaterialSpec& b : scene.materials)
      rules.friction.push_back(friction_of(scene, a.name, b.name));
  for (const ToolSpec& tool : scene.tools)
    for (const MaterialSpec& m : scene.materials)
      rules.tool_friction.push_back(is_constraint(tool) ? ContactRules::Friction{}
                                                        : friction_of(scene, tool.name, m.name));
  if (has_adhesion(scene)) add_adhesion(scene, rules);
  return rules;
}

}  // namespace pulvis
