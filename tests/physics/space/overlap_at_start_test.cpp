// Surfaces that overlap at the start: smooth ones bulge beyond the shape, so a cylinder placed exactly between its tools
// is pressed by them before the first step.
#include <gtest/gtest.h>

#include "tests/helpers/experiment.hpp"
#include "tests/helpers/plates.hpp"

namespace pulvis {
namespace {

Scene cylinder_in_its_die(const char* safety) {
  return own_scene(
      R"(family = "compaction"
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
)",
      {std::string("time.safety=") + safety, "time.estimate=element", "contact.stiffness=10"});
}

// -, of the energy of the overlap: at most, and at the end.
struct Lost {
  double most = 0, at_end = 0;
};
Lost lost_with(const char* safety) {
  Experiment e(cylinder_in_its_die(safety));
  double energy = 0;
  Lost lost;
  e.run(100, [&] {
    if (energy == 0) energy = e.value("energy/contact");
    lost.at_end = std::abs(e.value("energy/balance")) / energy;
    lost.most = std::max(lost.most, lost.at_end);
  });
  EXPECT_GT(energy, 1e-6);
  return lost;
}

// Law: conservation of energy, but for the error of the time integration, which is of second order. Starting with a step near
// the stability limit, and ignoring that pressed springs are stiffer, lost an eighth of it.
TEST(OverlapAtTheStart, KeepsItsEnergyToSecondOrder) {
  const Lost whole = lost_with("0.9"), half = lost_with("0.45"), quarter = lost_with("0.225");
  EXPECT_LT(whole.most, 0.03);
  // Contacts open and close in steps: the order shows over two halvings.
  EXPECT_LT(quarter.most, 0.3 * 0.3 * whole.most);
  EXPECT_LT(half.at_end, 0.003);
}

}  // namespace
}  // namespace pulvis
