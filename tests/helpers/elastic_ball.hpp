// A steel ball of 10 mm between two planes, of which the upper one comes down.
#pragma once

#include <string>

namespace pulvis {

// Keys of particle.mesh and of contact, and the way of the plane with its unit.
inline std::string elastic_ball(const std::string& mesh, const std::string& contact,
                                const std::string& way) {
  return R"(
family = "compaction"
dimension = 3
material = [{ name = "steel", density = "7990 kg/m^3", youngs_modulus = "200 GPa", poissons_ratio = 0.3 }]
body = [{ particle = "ball", position = ["0 mm", "0 mm", "5 mm"] }]
tool = [
  { name = "bottom", shape = "plane", point = ["0 mm", "0 mm", "0 mm"], normal = [0, 0, 1] },
  { name = "top", shape = "plane", point = ["0 mm", "0 mm", "10 mm"], normal = [0, 0, -1] },
]
particle = [{ name = "ball", material = "steel", shape = "sphere", diameter = "10 mm", mesh = { )" +
         mesh + " } }]\ncontact = { " + contact + R"( }

[[stage]]
name = "press"
kind = "compact"
duration = "50 us"
move = [{ tool = "top", displacement = ["0 mm", "0 mm", "-)" +
         way + "\"], ramp = 0.5 }]\n";
}

}  // namespace pulvis
