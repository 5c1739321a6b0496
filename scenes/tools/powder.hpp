// Bulk properties of a scene's powder, used to tune servos.
#pragma once

#include <vector>

#include "scenes/spec/scene.hpp"

namespace pulvis {

struct Powder {
  double mass = 0;       // kg
  double impedance = 0;  // Pa s/m, largest of its materials: density times dilatational wave speed
  double area = 0;       // m^2
};

Powder powder_of(const Scene& scene, const std::vector<BodySpec>& bodies);

}  // namespace pulvis
