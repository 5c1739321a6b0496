#include "scenes/results/particle_tags.hpp"

#include <algorithm>
#include <string>

#include "components/body.hpp"
#include "components/particle_classes.hpp"
#include "components/shape.hpp"
#include "engine/access.hpp"

namespace pulvis {
namespace {

// Grains are named "class#variant.grain" (scenes/grains/grains.cpp).
std::string class_name(const Scene& scene, int position) {
  const auto p = static_cast<std::size_t>(position);
  if (p >= scene.particles.size()) {
    const std::string& name = scene.grains.at(p - scene.particles.size()).name;
    return name.substr(0, name.rfind('#'));
  }
  const ParticleSpec& spec = scene.particles[p];
  return spec.class_of < 0 ? spec.name
                           : scene.particles[static_cast<std::size_t>(spec.class_of)].name;
}

std::int32_t position_of(std::vector<std::string>& names, const std::string& name) {
  const auto found = std::ranges::find(names, name);
  if (found == names.end()) names.push_back(name);
  return static_cast<std::int32_t>(std::ranges::find(names, name) - names.begin());
}

}  // namespace

std::vector<ParticleTag> particle_tags(const Scene& scene, const World& world) {
  const auto& bodies = world.resource<Bodies>();
  const auto& classes = world.resource<ParticleClasses>().of_shape;
  ParticleTag number{"number", "particle", "of the particle, from 0", {}, {}};
  ParticleTag material{"material", "material", "position in `names`", {}, {}};
  ParticleTag of_class{"class", "class", "position in `names`", {}, {}};
  for (const MaterialSpec& m : scene.materials) material.names.push_back(m.name);
  std::vector<std::int32_t> class_of_shape;
  for (const int position : classes)
    class_of_shape.push_back(position_of(of_class.names, class_name(scene, position)));
  for (const int slot : bodies.slot_of_number) {
    const Bodies::Slot& s = entry(bodies.slots, slot);
    number.values.push_back(s.number);
    material.values.push_back(s.material);
    of_class.values.push_back(entry(class_of_shape, s.shape));
  }
  return {number, material, of_class};
}

}  // namespace pulvis
