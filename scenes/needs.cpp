#include "scenes/needs.hpp"

#include <algorithm>

#include "scenes/outlines/outline.hpp"
#include "scenes/spec/yield.hpp"
#include "scenes/tools/bond_rules.hpp"
#include "scenes/tools/contact_rules.hpp"
#include "systems/laws/flow_law.hpp"

namespace pulvis {
namespace {

// Whether any pair that can touch has friction that satisfies `acts`.
template <class Acts>
bool any_friction(const ContactRules& rules, const Needs& needs, const Acts& acts) {
  const auto is = [&](const SurfaceLaws& of) { return acts(of.friction); };
  return (needs.pairs && std::ranges::any_of(rules.pairs, is)) ||
         (needs.tools && std::ranges::any_of(rules.tool_pairs, is));
}

// Solids have no outline.
template <class Is>
bool any_outline(const Scene& scene, const Is& is) {
  return std::ranges::any_of(scene.particles, [&](const ParticleSpec& p) {
    return outline_area(p.outline) > 0 && is(p.outline);
  });
}

}  // namespace

Needs needs_of(const Scene& scene, std::size_t particles) {
  Needs needs;
  needs.plastic = any_material_yields(scene);
  needs.flow_laws =
      std::ranges::any_of(scene.materials, [](const MaterialSpec& m) { return bool(m.flow); });
  const auto any = [&](ToolSpec::Shape shape) {
    return std::ranges::any_of(scene.tools, [&](const ToolSpec& t) { return t.shape == shape; });
  };
  needs.polylines = any(ToolSpec::Shape::polyline);
  needs.tools = std::ranges::any_of(
      scene.tools, [](const ToolSpec& t) { return t.shape != ToolSpec::Shape::constraint; });
  needs.constraints = any(ToolSpec::Shape::constraint);
  needs.cell = scene.cell.has_value();
  needs.pairs = particles > 1 || needs.cell || (needs.tools && any_outline(scene, can_fold)) ||
                (needs.constraints && any_outline(scene, has_notch));
  using Friction = FrictionParameters;
  const ContactRules rules = contact_rules(scene);
  needs.friction = any_friction(rules, needs, [](const Friction& f) { return f.acts(); });
  needs.weakening = needs.friction &&
                    any_friction(rules, needs, [](const Friction& f) { return !f.only_coulomb(); });
  if (!scene.bonds.empty()) {
    const BondRules bonds = bond_rules(scene);
    needs.adhesion = needs.contact() && has_adhesion(scene);
    needs.welds = needs.pairs && BondRules::any(bonds.pressed);
    needs.tool_welds = needs.tools && BondRules::any(bonds.tool_pressed);
    needs.initial_bonds =
        needs.pairs && (BondRules::any(bonds.initial) || BondRules::any(bonds.inside));
    needs.tool_initial_bonds = needs.tools && BondRules::any(bonds.tool_initial);
  }
  needs.indentation = needs.contact() && needs.plastic && scene.contact.hardness;
  needs.inerters = needs.contact() && scene.contact.inertance > 0;
  needs.formulation = scene.element.formulation;
  needs.damping = needs.contact() && scene.contact.damping > 0;
  needs.bulk_damping = std::ranges::any_of(scene.materials, &MaterialSpec::damped);
  return needs;
}

}  // namespace pulvis
