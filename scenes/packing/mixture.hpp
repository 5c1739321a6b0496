// Which particles a random packing consists of: its classes, shares and sizes as whole numbers.
#pragma once

#include "scenes/language/table_reader.hpp"
#include "scenes/spec/scene.hpp"

#include <vector>

namespace pulvis {

struct MixtureSize {
  int particle = 0;  // position in Scene::particles
  double scale = 1;  // of the class's outline
  int count = 0;
};

struct Mixture {
  std::vector<MixtureSize> sizes;  // class by class, from small to large
  int count = 0;
  double area = 0;  // m^2, of all
};

// What the classes ask for; `path` is that of the packing. Problems are noted, the mixture is empty then.
Mixture mixture_of(const Scene& scene, const PackingSpec& packing, const std::string& path,
                   const schema::Origins& origins, Problems& problems);

}  // namespace pulvis
