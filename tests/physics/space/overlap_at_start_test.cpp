// Surfaces that overlap at the start: smooth ones bulge beyond the shape, so a cylinder placed exactly between its tools
// is pressed by them before the first step.
#include <gtest/gtest.h>

#include "tests/helpers/experiment.hpp"
#include "tests/helpers/plates.hpp"

namespace pulvis {
namespace {

Scene cylinder_in_its_die() {
  return own_scene(R"(family = "compaction"
dimension = 3

[[material]]
name = "elastic"
density = "8000 kg/m^3"
youngs_modulus = "100 GPa"
poissons_ratio = 0.2

[[particle]]
name = "cylinder"
material = "elastic"
shape = "cylinder"
diameter = "1 mm"
height = "1 mm"
rounding = "0.05 mm"
mesh = { divisions = 4, rings = 2, axial_divisions = 6, grid = "extruded" }

[[body]]
particle = "cylinder"
position = ["0 mm", "0 mm", "0.5 mm"]

[[tool]]
name = "die"
shape = "die"
point = ["0 mm", "0 mm", "0 mm"]
diameter = "1 mm"
)" + plates("1 mm") +
                   R"(
[[stage]]
name = "rest"
kind = "settle"
duration = "2 us"
)");
}

// Law: conservation of energy. Starting with a step near the stability limit, and ignoring that pressed springs are stiffer,
// lost an eighth of it.
TEST(OverlapAtTheStart, KeepsItsEnergy) {
  Experiment e(cylinder_in_its_die());
  double energy = 0, lost = 0;
  e.run(100, [&] {
    if (energy == 0) energy = e.value("energy/contact");
    lost = std::max(lost, std::abs(e.value("energy/balance")));
  });
  ASSERT_GT(energy, 1e-6);
  EXPECT_LT(lost, 0.03 * energy);
  EXPECT_LT(std::abs(e.value("energy/balance")), 0.01 * energy);
}

}  // namespace
}  // namespace pulvis
