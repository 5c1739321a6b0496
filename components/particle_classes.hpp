// Maps the shapes of the bodies to the particle classes of the scene; used for output only.
#pragma once

#include <vector>

namespace pulvis {

struct ParticleClasses {
  static constexpr const char* resource_name = "particle_classes";
  static constexpr bool fixed = true;
  std::vector<int> of_shape;  // [Bodies::shapes], position in Scene::particles, then Scene::grains
};

}  // namespace pulvis
