#include "scenes/spec/yield.hpp"

#include <algorithm>

namespace pulvis {

bool any_material_yields(const Scene& scene) {
  return std::ranges::any_of(scene.materials,
                             [](const MaterialSpec& m) { return m.yield_stress.has_value(); });
}

// Every material of a scene is used by one of its particles: the reader refuses unused ones.
std::optional<double> common_yield_stress(const Scene& scene) {
  std::optional<double> common;
  for (const MaterialSpec& material : scene.materials) {
    if (!material.yield_stress || (common && *common != *material.yield_stress))
      return std::nullopt;
    common = material.yield_stress;
  }
  return common;
}

}  // namespace pulvis
