// Which class of the scene the shapes of its bodies are of: for results, nothing in the step reads it.
#pragma once

#include <vector>

namespace pulvis {

struct ParticleClasses {
  static constexpr const char* resource_name = "particle_classes";
  static constexpr bool fixed = true;
  std::vector<int> of_shape;  // [Bodies::shapes], position in Scene::particles, then Scene::grains
};

}  // namespace pulvis
