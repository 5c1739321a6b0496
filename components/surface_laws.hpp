// What acts between the surfaces of two materials, or of a tool and a material. Scenes declare it, laws read it: a new
// number is a member here, a key in scenes/keys/declare_process.cpp and its effect in systems/laws.
#pragma once

#include <cmath>
#include <limits>
#include <optional>

namespace pulvis {

struct FrictionParameters {
  double coefficient = 0;  // -, Coulomb's; the dynamic one if there is also a static one
  std::optional<double> static_coefficient = std::nullopt;  // -, before sliding
  // m, sliding distance over which the difference decays to 1/e
  double decay_length = std::numeric_limits<double>::infinity();
  double shear_strength = std::numeric_limits<double>::infinity();  // Pa, limit of the shear stress
  double rate = 0;  // -, sliding at speed v adds rate ln(1 + v/reference_speed)
  double reference_speed = std::numeric_limits<double>::infinity();  // m/s

  // -, static minus dynamic coefficient
  double static_excess() const { return static_coefficient.value_or(coefficient) - coefficient; }
  bool acts() const { return coefficient > 0 || static_excess() > 0 || rate > 0; }
  bool only_coulomb() const {
    return static_excess() == 0 && rate == 0 && std::isinf(shear_strength);
  }
};

struct AdhesionParameters {
  double traction = 0;  // Pa, of touching surfaces
  double range = 0;     // m, gap at which it has dropped to zero
};

struct SurfaceLaws {
  FrictionParameters friction;
  AdhesionParameters adhesion;
};

}  // namespace pulvis
