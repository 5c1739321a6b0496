#include "scenes/tools/powder.hpp"

#include <algorithm>
#include <cmath>

#include "scenes/outlines/outline.hpp"

namespace pulvis {

Powder powder_of(const Scene& scene, const std::vector<BodySpec>& bodies) {
  Powder powder;
  for (const BodySpec& body : bodies) {
    const ParticleSpec& particle = scene.particles[static_cast<std::size_t>(body.particle)];
    const MaterialSpec& m = scene.materials[static_cast<std::size_t>(particle.material)];
    const double area = outline_area(particle.outline), nu = m.poissons_ratio;
    const double modulus = m.youngs_modulus * (1 - nu) / ((1 + nu) * (1 - 2 * nu));
    powder.area += area;
    powder.mass += m.density * area * scene.thickness;
    powder.impedance = std::max(powder.impedance, std::sqrt(m.density * modulus));
  }
  return powder;
}

}  // namespace pulvis
