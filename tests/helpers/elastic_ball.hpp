// A steel ball of 10 mm between two planes, of which the upper one comes down, and the law of its force.
#pragma once

#include <cmath>
#include <numbers>
#include <string>

namespace pulvis {

inline constexpr double ball_radius = 5e-3, ball_modulus = 200e9, ball_poisson = 0.3;

// N, of each of two opposite planes that have come so much nearer to its centre, m: Hertz, and the displacement by the other
// contact (Tatara 1991).
inline double force_on_ball(double approach) {
  constexpr double star = ball_modulus / (1 - ball_poisson * ball_poisson);
  double force = 0;
  for (int i = 0; i < 100; ++i) {
    const double a2 = std::pow(3 * force * ball_radius / (4 * star), 2.0 / 3),
                 far2 = a2 + 4 * ball_radius * ball_radius;
    const double far = 2 * (1 + ball_poisson) * ball_radius * ball_radius / std::pow(far2, 1.5) +
                       (1 - ball_poisson * ball_poisson) / std::sqrt(far2);
    const double near = approach + force / (std::numbers::pi * ball_modulus) * far;
    force = 4.0 / 3 * star * std::sqrt(ball_radius) * std::pow(near, 1.5);
  }
  return force;
}

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
