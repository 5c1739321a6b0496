#include "scenes/results/solids/space_tags.hpp"

#include <algorithm>
#include <string>

#include "components/particle_classes.hpp"
#include "components/shape.hpp"
#include "engine/access.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis::space {
namespace {

const std::string& name_of_class(const Scene& scene, int position) {
  const ParticleSpec& spec = scene.particles[static_cast<std::size_t>(position)];
  return spec.class_of < 0 ? spec.name
                           : scene.particles[static_cast<std::size_t>(spec.class_of)].name;
}

std::int32_t place_in(std::vector<std::string>& names, const std::string& name) {
  const auto found = std::ranges::find(names, name);
  if (found != names.end()) return static_cast<std::int32_t>(found - names.begin());
  names.push_back(name);
  return static_cast<std::int32_t>(names.size() - 1);
}

}  // namespace

std::vector<ParticleTag> particle_tags(const Scene& scene, const World& world) {
  const auto& bodies = world.resource<Bodies>();
  ParticleTag number{"number", "particle", "of the particle, from 0", {}, {}};
  ParticleTag material{"material", "material", "position in `names`", {}, {}};
  ParticleTag of_class{"class", "class", "position in `names`", {}, {}};
  for (const MaterialSpec& m : scene.materials) material.names.push_back(m.name);
  std::vector<std::int32_t> class_of_shape;
  for (const int position : world.resource<ParticleClasses>().of_shape)
    class_of_shape.push_back(place_in(of_class.names, name_of_class(scene, position)));
  for (const int slot : bodies.slot_of_number) {
    const Bodies::Slot& s = entry(bodies.slots, slot);
    number.values.push_back(s.number);
    material.values.push_back(s.material);
    of_class.values.push_back(entry(class_of_shape, s.shape));
  }
  return {number, material, of_class};
}

}  // namespace pulvis::space
