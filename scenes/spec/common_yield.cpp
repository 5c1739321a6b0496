#include "scenes/spec/common_yield.hpp"

namespace pulvis {

// Every material of a scene is one of its particles: the reader refuses others.
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
