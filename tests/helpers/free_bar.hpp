// An elastic bar of steel without any support, and its first bending mode.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <string>

namespace pulvis {

struct FreeBar {
  std::string formulation;
  int length, rows;  // mm, of 1 mm in height, an element a mm; elements across
  double poissons_ratio = 0.3;
  std::string damping;  // a table of the material
  std::string duration = "1 ms";

  std::string text() const {
    return fmt::format(R"(family = "compaction"
[element]
formulation = "{}"
[[material]]
name = "steel"
density = "7850 kg/m^3"
youngs_modulus = "200 GPa"
poissons_ratio = {}
{}[[particle]]
name = "bar"
material = "steel"
outline = "rectangle"
width = "{} mm"
height = "1 mm"
[particle.mesh]
columns = {}
rows = {}
[[body]]
particle = "bar"
position = ["0 mm", "0 mm"]
[[stage]]
name = "free"
kind = "settle"
duration = "{}"
)",
                       formulation, poissons_ratio, damping, length, length, rows, duration);
  }
};

inline constexpr double bending_root = 4.730040744862704;  // cos cosh = 1

// Of a bar with free ends, x in [-1/2, 1/2].
inline double bending_mode(double x) {
  constexpr double root = bending_root;
  const double k = (std::cosh(root) - std::cos(root)) / (std::sinh(root) - std::sin(root));
  const double s = root * (x + 0.5);
  return std::cosh(s) + std::cos(s) - k * (std::sinh(s) + std::sin(s));
}

}  // namespace pulvis
