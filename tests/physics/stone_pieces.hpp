// Scenes of bonded blocks of stone, from pieces of text.
#pragma once

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string>

namespace pulvis {

inline constexpr const char* bar_material = R"(
family = "compaction"
thickness = "1 mm"
[[material]]
name = "stone"
density = "2000 kg/m^3"
youngs_modulus = "20 GPa"
poissons_ratio = 0.25
[material.damping]
mass_proportional = "60000 1/s"
)";

inline std::string piece(const char* name, double length, double x, double y = 0) {
  return fmt::format(R"(
[[particle]]
name = "{0}"
material = "stone"
outline = "rectangle"
width = "{1} mm"
height = "1 mm"
[particle.mesh]
columns = {2}
rows = 10
[[body]]
particle = "{0}"
position = ["{3} mm", "{4} mm"]
)",
                     name, length, std::lround(10 * length), x, y);
}

inline std::string grip(const char* name, int body, const std::array<double, 4>& box,
                        const char* holds) {
  return fmt::format(
      "[[tool]]\nname = \"{}\"\nshape = \"constraint\"\nbody = {}\nlow = [\"{} mm\", \"{} mm\"]\n"
      "high = [\"{} mm\", \"{} mm\"]\nholds = \"{}\"\n",
      name, body, box[0], box[1], box[2], box[3], holds);
}

}  // namespace pulvis
