// A colloid probe of copper that is pressed beyond yield and let go.
#include <cmath>

#include "scenes/afm_loop.hpp"
#include "tests/afm/lever.hpp"

namespace pulvis {
namespace {

constexpr const char* copper_probe = R"(family = "afm"
[[material]]
name = "lever"
youngs_modulus = "200 GPa"
poissons_ratio = 0.3
[[material]]
name = "cu"
youngs_modulus = "115 GPa"
poissons_ratio = 0.35
yield_stress = "50 MPa"
hardening_modulus = "440 MPa"
[lever]
shape = "beam"
material = "lever"
length = "100 um"
width = "50 um"
thickness = "10 um"
[tip]
shape = "sphere"
material = "cu"
radius = "8 um"
neck_radius = "4 um"
neck_height = "1 um"
set_back = "20 um"
[surface]
shape = "plane"
[[action]]
kind = "press"
distance = "0.16 um"
increments = 8
[[action]]
kind = "retract"
distance = "0.16 um"
increments = 8
)";

struct ForceCurve {
  std::vector<double> height, force;
  double slope(std::size_t from, std::size_t to) const {
    return (force[to] - force[from]) / (height[to] - height[from]);
  }
};

ForceCurve curve_of(const std::vector<std::string>& overrides) {
  const Scene scene = afm_scene(copper_probe, overrides);
  AfmHistory history;
  AfmSimulation simulation(scene);
  simulation.run([&](double time, const std::vector<double>& row) {
    history.times.push_back(time);
    history.rows.push_back(row);
    return true;
  });
  ForceCurve curve;
  for (std::size_t i = 0; i < history.rows.size(); ++i) {
    curve.height.push_back(history.value(i, "scanner/z"));
    curve.force.push_back(history.value(i, "probe/force_z"));
  }
  return curve;
}

// It gives way more than an elastic one, springs back as stiffly as that, and leaves the surface early: by what
// it has sunk in.
TEST(PlasticProbe, UnloadsLikeAnElasticOneThatIsShorterByItsDent) {
  const ForceCurve elastic = curve_of({"material.cu.yield_stress=100 GPa"});
  const ForceCurve plastic = curve_of({});
  ASSERT_EQ(plastic.force.size(), 17u);
  EXPECT_NEAR(plastic.force[1] / elastic.force[1], 1, 1e-6);  // not yet
  EXPECT_LT(plastic.force[8], 0.995 * elastic.force[8]);
  const double stiffness = elastic.slope(1, 8);
  EXPECT_NEAR(plastic.slope(8, 12) / stiffness, 1, 0.01);
  EXPECT_NEAR(plastic.slope(12, 15) / stiffness, 1, 0.01);
  const double dent = elastic.height[8] - plastic.force[8] / stiffness;
  const double left_at = plastic.height[15] - plastic.force[15] / stiffness;
  EXPECT_GT(dent, 1e-10);
  EXPECT_NEAR(left_at / dent, 1, 0.15);
  EXPECT_EQ(plastic.force[16], 0);
}

}  // namespace
}  // namespace pulvis
