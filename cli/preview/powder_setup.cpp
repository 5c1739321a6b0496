#include "cli/preview/powder_setup.hpp"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "cli/preview/outline_setup.hpp"
#include "cli/preview/solid_setup.hpp"
#include "cli/preview/stage_setup.hpp"
#include "engine/enum_table.hpp"
#include "scenes/tools/contact_rules.hpp"
#include "systems/laws/flow_law.hpp"

namespace pulvis {
namespace {

using nlohmann::json;

constexpr EnumTable<BondSpec::Origin> bond_origins{"initial", "pressed", "adhesion"};

json material_setup(const MaterialSpec& material) {
  json out{{"name", material.name},
           {"density", material.density},
           {"youngs_modulus", material.youngs_modulus},
           {"poissons_ratio", material.poissons_ratio}};
  if (material.yield_stress) out["yield_stress"] = *material.yield_stress;
  if (material.flow) out["flow_law"] = name_of(*material.flow);
  if (material.hardening_modulus > 0) out["hardening_modulus"] = material.hardening_modulus;
  return out;
}

json materials_setup(const Scene& scene) {
  json out = json::array();
  for (const MaterialSpec& material : scene.materials) out.push_back(material_setup(material));
  return out;
}

// Friction between particles, for every pair of materials.
json pairs_setup(const Scene& scene) {
  json out = json::array();
  for (std::size_t a = 0; a < scene.materials.size(); ++a)
    for (std::size_t b = a; b < scene.materials.size(); ++b) {
      const std::string &first = scene.materials[a].name, &second = scene.materials[b].name;
      out.push_back({{"first", first},
                     {"second", second},
                     {"coefficient", friction_of(scene, first, second).coefficient}});
    }
  return out;
}

json bond_laws(const Scene& scene) {
  json laws = json::array();
  for (const BondSpec& bond : scene.bonds) {
    json law{{"first", bond.first},
             {"second", bond.second},
             {"origin", bond_origins[bond.origin]},
             {"inside", bond.inside}};
    if (bond.strength) law["strength"] = *bond.strength;
    if (bond.work > 0) law.update({{"work", bond.work}, {"range", bond.range}});
    laws.push_back(std::move(law));
  }
  return laws;
}

// [lowest, highest], null before the first.
void widen(json& range, double value) {
  if (range.is_null()) range = {value, value};
  range[0] = std::min(range[0].get<double>(), value);
  range[1] = std::max(range[1].get<double>(), value);
}

struct ClassOf {
  const ParticleSpec* declared = nullptr;
  int count = 0;
  std::map<int, const ParticleSpec*> sizes;
};

json class_setup(const Scene& scene, const ClassOf& found) {
  const ParticleSpec& spec = *found.declared;
  json out = scene.in_space() ? solid_class(spec) : outline_class(spec);
  out["name"] = spec.name;
  out["material"] = scene.materials[static_cast<std::size_t>(spec.material)].name;
  out["count"] = found.count;
  for (const auto& [number, sized] : found.sizes) {
    const ClassSize size = scene.in_space() ? solid_size(*sized) : outline_size(*sized);
    widen(out["diameter"], size.diameter);
    if (size.width) widen(out["width"], *size.width);
    if (size.height) widen(out["height"], *size.height);
  }
  return out;
}

json classes_setup(const Scene& scene, const std::vector<BodySpec>& particles) {
  std::map<const ParticleSpec*, ClassOf> classes;  // in the order of the scene
  for (const BodySpec& body : particles) {
    const ParticleSpec& base = base_of(scene, body);
    ClassOf& of = classes[&base];
    of.declared = &base;
    of.count += 1;
    of.sizes[body.particle] = &scene.class_of(body);
  }
  json out = json::array();
  for (const auto& [base, found] : classes) out.push_back(class_setup(scene, found));
  return out;
}

}  // namespace

const ParticleSpec& base_of(const Scene& scene, const BodySpec& body) {
  const ParticleSpec& spec = scene.class_of(body);
  return spec.class_of < 0 ? spec : scene.particles[static_cast<std::size_t>(spec.class_of)];
}

json powder_setup(const Scene& scene, const std::vector<BodySpec>& particles, const World& world) {
  json setup = scene.in_space() ? solid_setup(scene, particles, world)
                                : outline_setup(scene, particles, world);
  setup["family"] = "particles";
  setup["friction"] = pairs_setup(scene);
  setup["materials"] = materials_setup(scene);
  setup["count"] = particles.size();
  setup["classes"] = classes_setup(scene, particles);
  setup["stages"] = stage_setup(scene);
  setup["bonds"]["laws"] = bond_laws(scene);
  if (scene.initial_state) setup["initial_state"] = *scene.initial_state;
  return setup;
}

}  // namespace pulvis
