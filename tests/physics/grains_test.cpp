// A particle of grains that hold is the particle: in the diametral test, when it turns, and where grains meet in a valley.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "tests/helpers/crystal.hpp"
#include "tests/helpers/experiment.hpp"

namespace pulvis {
namespace {

struct Stress {
  double xx = 0, yy = 0;  // Pa
};

// By Hertz (1883), of two point loads on a disc of radius R about the origin, over their load per thickness.
Stress of_two_loads(double x, double y, double R) {
  const double up = (R - y) * (R - y) + x * x, down = (R + y) * (R + y) + x * x;
  const auto cube = [](double v) { return v * v * v; };
  return {-2 / std::numbers::pi *
              ((R - y) * x * x / (up * up) + (R + y) * x * x / (down * down) - 1 / (2 * R)),
          -2 / std::numbers::pi *
              (cube(R - y) / (up * up) + cube(R + y) / (down * down) - 1 / (2 * R))};
}

// Mean stresses near the centre, over those of the law: 2P/(pi D t) and -6P/(pi D t) at the centre itself.
Stress near_the_centre(Experiment& e, double R) {
  constexpr double near = 0.2;
  const World& world = e.simulation.world();
  const Bodies& bodies = world.resource<Bodies>();
  const double load = e.value("tool/top/force_y") / e.scene.thickness;
  const auto& x = e.column<Position<TwoD>>();
  const auto& s = e.column<DeviatoricStress<TwoD, 1>>();
  const auto& p = e.column<MeanStress<1>>();
  Stress sum, law;
  for (int slot = 0; slot < static_cast<int>(bodies.slots.size()); ++slot) {
    if (bodies.slots[static_cast<std::size_t>(slot)].number < 0) continue;
    const auto chunk = static_cast<std::size_t>(slot / lane_count);
    const int lane = slot % lane_count;
    const Shape& shape = bodies.shape_of_slot(slot);
    for (std::size_t q = 0; q < shape.quads.size(); ++q) {
      double cx = 0, cy = -R;
      for (const Row<Node> n : shape.quads[q]) {
        const auto row = static_cast<std::size_t>(x.table.chunk_begin[chunk] + n.value);
        cx += x.lanes()[2 * row][lane] / 4;
        cy += x.lanes()[2 * row + 1][lane] / 4;
      }
      if (std::hypot(cx, cy) > near * R) continue;
      const auto row = static_cast<std::size_t>(s.table.chunk_begin[chunk]) + q;
      const double area = shape.centre[q][0].determinant;
      const double mean = p.lanes()[row][lane];
      sum.xx += area * (s.lanes()[3 * row][lane] + mean);
      sum.yy += area * (s.lanes()[3 * row + 1][lane] + mean);
      const Stress exact = of_two_loads(cx, cy, R);
      law.xx += area * load * exact.xx;
      law.yy += area * load * exact.yy;
    }
  }
  return {sum.xx / law.xx, sum.yy / law.yy};
}

TEST(BrazilianDisc, OfGrainsHasTheStressesOfTheElasticDiscAtItsCentre) {
  Experiment e(own_scene(R"(
extends = "bonds/brazilian-disc.toml"
[[material]]
name = "salt"
damping.mass_proportional = "200000 1/s"
[[bond]]
between = ["salt", "salt"]
origin = "initial"
strength = "1 GPa"
fracture_energy = "50 kJ/m^2"
stiffness = 2
[[stage]]
name = "press"
duration = "0.1 ms"
[[stage.move]]
tool = "top"
displacement = ["0 mm", "-0.01 mm"]
[[stage]]
name = "rest"
kind = "hold"
duration = "0.1 ms"
)"));
  e.run(2);
  const Stress share = near_the_centre(e, 5e-3);
  EXPECT_NEAR(share.xx, 1, 0.02);
  EXPECT_NEAR(share.yy, 1, 0.02);
}

// Two turns in 4.2 ms: every bond turns with its surfaces.
TEST(Grains, TurnWithoutStress) {
  const auto energies = [](const char* grains) {
    Experiment e(own_scene(Crystal{
        .grains = grains, .motion = "angular_velocity = \"3000 rad/s\"", .duration = "4.2 ms"}
                               .text()));
    double elastic = 0;
    e.run(50, [&] { elastic += (e.results.energies().elastic + e.results.energies().bonds) / 51; });
    EXPECT_LT(e.results.energy_balance_error(), 1e-6);
    return std::array{elastic, e.results.energies().kinetic};
  };
  const auto whole = energies("");
  const auto grains = energies(R"([particle.grains]
number = 12
[[bond]]
between = ["salt", "salt"]
origin = "initial"
strength = "20 MPa"
fracture_energy = "200 J/m^2"
)");
  EXPECT_NEAR(grains[1], whole[1], 0.02 * whole[1]);  // lumped masses turn more slowly by the mesh
  EXPECT_NEAR(grains[0], whole[0], 0.1 * whole[0]);
  EXPECT_LT(grains[0], 1e-3 * grains[1]);
}

// A sharp block falls into the valley of a particle of two grains that meet in it, wherever its corner strikes.
TEST(Grains, OfAValleyPushOutWithHardlyAGainOrLoss) {
  const char* const valley = R"(outline = "polygon"
rounding = "0.02 mm"
corners = [["-10 mm", "-4 mm"], ["10 mm", "-4 mm"], ["10 mm", "2 mm"], ["0 mm", "0 mm"], ["-10 mm", "2 mm"]])";
  for (const char* x : {"-0.1", "-0.05", "0.05"}) {
    const std::string block = fmt::format(R"([[body]]
particle = "block"
position = ["{} mm", "3.1 mm"]
angle = "45 deg"
velocity = ["5 m/s", "-20 m/s"])",
                                          x);
    Experiment e(own_scene(Crystal{.outline = valley,
                                   .grains = R"([particle.grains]
number = 2
relaxation = 200
[[bond]]
between = ["salt", "salt"]
origin = "initial"
inside = true
strength = "10 GPa"
fracture_energy = "5 MJ/m^2"
[[particle]]
name = "block"
material = "salt"
outline = "rectangle"
width = "2 mm"
height = "2 mm"
[particle.mesh]
columns = 3
rows = 3
[contact]
stiffness = 0.35)",
                                   .motion = block,
                                   .duration = "0.2 ms"}
                               .text()));
    e.run(20);
    EXPECT_LT(e.results.energy_balance_error(), 0.02) << x;
  }
}

}  // namespace
}  // namespace pulvis
