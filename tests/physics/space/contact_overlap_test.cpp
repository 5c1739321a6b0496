// contact_overlap in three dimensions: of rigid balls, whose overlap with a plane and with each other is known.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/helpers/experiment.hpp"

namespace pulvis {
namespace {

constexpr double held_radius = 5e-3, way = 0.2e-3, pi = std::numbers::pi;

// Balls of 10 mm whose nodes are all held; the first one goes down by 0.2 mm.
Scene rigid_balls(const std::string& more) {
  return own_scene(R"(
family = "compaction"
dimension = 3
material = [{ name = "steel", density = "7990 kg/m^3", youngs_modulus = "200 GPa", poissons_ratio = 0.3 }]
particle = [{ name = "ball", material = "steel", shape = "sphere", diameter = "10 mm", mesh = { divisions = 6, rings = 1 } }]
limits = { penetration = 1 }
[[body]]
particle = "ball"
position = ["0 mm", "0 mm", "5 mm"]
[[tool]]
name = "first"
shape = "constraint"
point = ["0 mm", "0 mm", "5 mm"]
radius = "5.1 mm"
holds = "all"
[[stage]]
name = "lower"
kind = "compact"
duration = "20 us"
move = [{ tool = "first", displacement = ["0 mm", "0 mm", "-0.2 mm"], ramp = 0.5 }]
)" + more);
}

// m^3, integral over the surface of a ball. `depth_at`: of a point so far above its lowest.
template <class DepthAt>
double integral(double up_to, const DepthAt& depth_at) {
  constexpr int parts = 1000;
  double sum = 0;
  for (int i = 0; i < parts; ++i) sum += depth_at((i + 0.5) / parts * up_to);
  return 2 * pi * held_radius * up_to * sum / parts;
}

TEST(ContactOverlapInSpace, OfABallWithAPlane) {
  Experiment e(
      rigid_balls("[[tool]]\nname = \"floor\"\nshape = \"plane\"\npoint = [\"0 mm\", \"0 mm\", \"0 "
                  "mm\"]\nnormal = [0, 0, 1]\n"));
  e.run(5);
  const double volume = 4.0 / 3 * pi * std::pow(held_radius, 3);
  const double wanted = integral(way, [](double height) { return way - height; });
  EXPECT_NEAR(wanted / (pi * held_radius * way * way), 1, 1e-4);
  EXPECT_NEAR(e.value("contact_overlap") * volume / wanted, 1, 0.02);
  EXPECT_NEAR(e.value("tool/floor/force_z") / -e.value("tool/first/force_z"), 1, 0.02);
}

// Each surface sees the whole of it, and counts half.
TEST(ContactOverlapInSpace, OfTwoBalls) {
  Experiment e(rigid_balls(
      "[[body]]\nparticle = \"ball\"\nposition = [\"0 mm\", \"0 mm\", \"-5 mm\"]\n[[tool]]\nname = "
      "\"second\"\nshape = \"constraint\"\nbody = 1\npoint = [\"0 mm\", \"0 mm\", \"-5 "
      "mm\"]\nradius = \"5.1 mm\"\nholds = \"all\"\n"));
  e.run(5);
  const double volume = 2 * 4.0 / 3 * pi * std::pow(held_radius, 3), apart = 2 * held_radius - way;
  const double wanted = integral(way, [&](double height) {
    const double away =
        std::sqrt(std::pow(held_radius - way, 2) + 2 * apart * height);  // from the other's centre
    return std::max(held_radius - away, 0.0);
  });
  EXPECT_NEAR(wanted / (pi * held_radius * way * way / 2), 1, 0.05);
  EXPECT_NEAR(e.value("contact_overlap") * volume / wanted, 1, 0.03);
}

}  // namespace
}  // namespace pulvis
