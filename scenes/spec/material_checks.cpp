#include "scenes/spec/material_checks.hpp"

#include <fmt/format.h>

namespace pulvis {

// A yield strain of 1 is far beyond any solid; it nearly always means a wrong prefix (GPa for MPa).
void check_materials(const Scene& scene, const Refuse& refuse) {
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    const MaterialSpec& material = scene.materials[i];
    const std::string path = fmt::format("material[{}].", i);
    if (material.yield_stress && *material.yield_stress >= material.youngs_modulus)
      refuse(path + "yield_stress",
             fmt::format("{:g} Pa is not below Young's modulus, the material would never yield, "
                         "allowed: < {:g} Pa",
                         *material.yield_stress, material.youngs_modulus));
    if (material.hardening_modulus > material.youngs_modulus)
      refuse(path + "hardening_modulus",
             fmt::format("{:g} Pa is above Young's modulus, plastic flow would be stiffer than "
                         "elasticity, allowed: <= {:g} Pa",
                         material.hardening_modulus, material.youngs_modulus));
  }
}

}  // namespace pulvis
