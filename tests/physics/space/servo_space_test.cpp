// A servo in three dimensions and the axes of the scene.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "tests/helpers/experiment.hpp"
#include "tests/helpers/plates.hpp"

namespace pulvis {
namespace {

// Spheres in a row at an angle from the x axis, pressed by a servo; their meshes turn with the row.
Scene row_of_spheres(double angle) {
  std::string bodies;
  for (const double place : {-1.55, -0.52, 0.52, 1.55})
    bodies += fmt::format(R"(
[[body]]
particle = "ball"
position = ["{:.15g} mm", "{:.15g} mm", "0.5 mm"]
angle = "{:.15g} rad"
)",
                          place * std::cos(angle), place * std::sin(angle), angle);
  return own_scene(R"(family = "compaction"
dimension = 3

[[material]]
name = "316L"
library = "316L"

[[particle]]
name = "ball"
material = "316L"
shape = "sphere"
diameter = "1 mm"
mesh = { divisions = 3, rings = 1 }
)" + bodies + R"(
)" + plates("1 mm") +
                   R"(
[[stage]]
name = "press"
kind = "compact"
duration = "20 us"
servo = [{ tool = "top", force = "1 kN", response = 0.5, tolerance = 5 }]

[contact]
friction = 0.1
)");
}

// Law: a rotation of the whole scene about the servo's direction changes nothing. The dashpot used a box along the axes, which
// is several times larger around a row on its diagonal.
TEST(ServoInSpace, DoesNotDependOnTheAxesOfTheScene) {
  Experiment along(row_of_spheres(0)), diagonal(row_of_spheres(std::numbers::pi / 4));
  std::vector<double> forces, others;
  along.run(40, [&] { forces.push_back(along.value("tool/top/force_z")); });
  diagonal.run(40, [&] { others.push_back(diagonal.value("tool/top/force_z")); });
  const double largest = *std::ranges::max_element(forces);
  ASSERT_GT(largest, 400);
  double apart = 0;
  for (std::size_t i = 0; i < forces.size(); ++i)
    apart = std::max(apart, std::abs(forces[i] - others[i]));
  EXPECT_LT(apart, 1e-6 * largest);
}

}  // namespace
}  // namespace pulvis
