// The error of a held stress decays, whatever the inertia of the cell: the powder and its cell exchange no energy other than
// the work of the target stress.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tests/helpers/experiment.hpp"

namespace pulvis {
namespace {

// Sixteen copper discs, pressed isostatically to 40 MPa.
std::string sixteen_discs(const std::string& duration, const std::string& more) {
  return R"(family = "compaction"
seed = 1
[[material]]
name = "Cu"
density = "8940 kg/m^3"
youngs_modulus = "115 GPa"
poissons_ratio = 0.35
yield_stress = "50 MPa"
hardening_modulus = "440 MPa"
[[particle]]
name = "disc"
material = "Cu"
outline = "disc"
diameter = "1 mm"
[particle.mesh]
boundary_edges = 24
rings = 1
[cell]
width = "4 mm"
[[packing]]
kind = "random"
width = "4 mm"
density = 0.8
class = [{ particle = "disc", number = 16 }]
[contact]
friction = 0.2
damping = 0.1
[[stage]]
name = "press"
kind = "compact"
duration = ")" +
         duration + R"("
[stage.cell]
stress_xx = "-40 MPa"
stress_yy = "-40 MPa"
stress_xy = "0 MPa"
tolerance = 1
)" + more;
}

// Largest error of the three stresses after `from`, Pa.
double error_after(double from, Experiment& e, double pressure) {
  double worst = 0;
  e.run(400, [&] {
    if (e.simulation.clock().time < from) return;
    worst = std::max({worst, std::abs(e.value("cell/stress_xx") + pressure),
                      std::abs(e.value("cell/stress_yy") + pressure),
                      std::abs(e.value("cell/stress_xy"))});
  });
  EXPECT_LT(e.results.energy_balance_error(), 1e-3);
  return worst;
}

// Sheared, then unloaded to a fortieth of the pressure: few contacts, which slide.
constexpr const char* relaxed = R"(
[[stage]]
name = "shear"
kind = "shear"
duration = "0.3 ms"
[stage.cell]
strain_xx = 0.01
strain_yy = -0.06
strain_xy = 0.02
rotation = "10 deg"
[[stage]]
name = "relax"
kind = "unload"
duration = "1 ms"
[stage.cell]
stress_xx = "-1 MPa"
stress_yy = "-1 MPa"
stress_xy = "0 MPa"
rise = 0.1
tolerance = 1
)";

TEST(StressControl, ItsErrorDecaysAfterUnloading) {
  Experiment e(own_scene(sixteen_discs("0.3 ms", relaxed)));
  EXPECT_LT(error_after(1.5e-3, e, 1e6), 3e3);
}

TEST(StressControl, ItsErrorDecaysWithLittleInertia) {
  Experiment e(own_scene(sixteen_discs("1 ms", "response = 0.02\n")));
  EXPECT_LT(error_after(0.9e-3, e, 40e6), 4e3);
}

}  // namespace
}  // namespace pulvis
