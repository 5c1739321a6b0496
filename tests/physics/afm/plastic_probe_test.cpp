// A colloid probe of copper that is pressed beyond yield and let go.
#include <cmath>
#include <numbers>

#include "components/solid.hpp"
#include "scenes/lever/afm_loop.hpp"
#include "tests/helpers/afm_run.hpp"

namespace pulvis {
namespace {

// Materials: copper, and an elastic one for the lever.
std::string copper_and(const std::string& lever, const std::string& youngs_modulus) {
  return R"(family = "afm"
[[material]]
name = "cu"
youngs_modulus = "115 GPa"
poissons_ratio = 0.35
yield_stress = "50 MPa"
hardening_modulus = "440 MPa"
[[material]]
poissons_ratio = 0.3
name = ")" +
         lever + "\"\nyoungs_modulus = \"" + youngs_modulus + "\"\n";
}

const std::string copper_probe = copper_and("lever", "200 GPa") + R"([lever]
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
  const AfmHistory history = history_of(afm_scene(copper_probe, overrides));
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

// A square pillar of copper under a stiff lever, pressed evenly on its end: far from its foot it is in simple
// compression, and keeps (sigma - sigma_y)/H of its length when it is let go. The strain is Green's, the stress
// its conjugate: sigma = F/(A lambda), lambda^2 = 1 + 2 E.
const std::string pillar = copper_and("stiff", "10 TPa") + R"([lever]
shape = "beam"
material = "stiff"
length = "60 um"
width = "60 um"
thickness = "25 um"
foot_edge = 0.25
foot_layers = 0
side_aspect = 10
[tip]
shape = "block"
material = "cu"
height = "16 um"
foot = "2 um"
set_back = "30 um"
)";

constexpr double young = 115e9, yield = 50e6, hardening = 440e6;

struct Pillar {
  double loaded = 1, released = 1;  // its length over that at rest
};

Pillar pillar_of(double force, double area) {
  Pillar p;
  double stress = 0;
  for (int i = 0; i < 50; ++i) {
    stress = force / (area * p.loaded);
    p.loaded = std::sqrt(1 - 2 * (stress / young + (stress - yield) / hardening));
  }
  p.released = std::sqrt(1 - 2 * (stress - yield) / hardening);
  return p;
}

// How much nearer the end has come to the level of nodes nearest to `length` above it, over their distance.
double shortening(AfmSimulation& simulation, double length) {
  const double* u = simulation.world().column<Displacement>().values();
  const double* x = simulation.world().column<ReferencePosition>().values();
  const double end = read(simulation.model().end, x).z();
  double level = 0;
  for (std::size_t n = 0; n < simulation.model().nodes; ++n)
    if (const double height = x[3 * n + 2] - end;
        std::abs(height - length) < std::abs(level - length))
      level = height;
  EXPECT_NEAR(level, length, 0.2 * length);
  double sum = 0;
  int nodes = 0;
  for (std::size_t n = 0; n < simulation.model().nodes; ++n)
    if (std::abs(x[3 * n + 2] - end - level) < 1e-9) sum += u[3 * n + 2], ++nodes;
  EXPECT_GE(nodes, 25);
  return (read(simulation.model().end, u).z() - sum / nodes) / level;
}

TEST(PlasticProbe, APillarKeepsThePlasticStrainOfSimpleCompression) {
  const Scene scene = afm_scene(pillar);
  AfmSimulation simulation(scene);
  const double area = 4e-12, length = 4e-6;
  for (const double stress : {40e6, 52e6, 54e6, 56e6})
    ASSERT_TRUE(simulation.load_tip({0, 0, stress * area}).converged) << stress;
  const Pillar law = pillar_of(56e6 * area, area);
  EXPECT_NEAR(shortening(simulation, length) / (1 - law.loaded), 1, 1e-4);
  for (const double stress : {25e6, 0.0})
    ASSERT_TRUE(simulation.load_tip({0, 0, stress * area}).converged) << stress;
  EXPECT_GT(1 - law.released, 0.01);
  EXPECT_NEAR(shortening(simulation, length) / (1 - law.released), 1, 1e-4);
}

// Fully plastic, a ball's mesh resolves it: the pressure is Tabor's, even, so that 5/2 <r^2>, which the
// programme calls contact/radius^2, is 5/4 a^2. Unloading is elastic: 2 E* a at first, and the plane is left
// when 2/pi (of an even pressure) to 3/4 (of Hertz's) of F/(E* a) has sprung back.
TEST(PlasticProbe, AResolvedBallHasTaborsPressureAndLeavesADentByElasticUnloading) {
  const FiledHistory h = run_shipped_afm("plastic-probe");
  ASSERT_EQ(h.samples(), 10u);
  const std::size_t top = 3;
  const double f = h.value(top, "probe/force_z"), reduced = young / (1 - 0.35 * 0.35);
  const double a = std::sqrt(0.8) * h.value(top, "contact/radius");
  const double pressure = f / (std::numbers::pi * a * a) / yield;
  EXPECT_GT(pressure, 2.8);
  EXPECT_LT(pressure, 3.15);
  const auto raised = [&](std::size_t i) {
    return h.value(top, "scanner/z") - h.value(i, "scanner/z");
  };
  const double stiffness = (f - h.value(top + 1, "probe/force_z")) / raised(top + 1);
  EXPECT_NEAR(stiffness / (2 * reduced * a), 1, 0.05);
  // The end of unloading goes as Hertz's power 3/2.
  const double before = std::pow(h.value(top + 3, "probe/force_z"), 2.0 / 3);
  const double after = std::pow(h.value(top + 4, "probe/force_z"), 2.0 / 3);
  const double left =
      raised(top + 4) + (raised(top + 4) - raised(top + 3)) * after / (before - after);
  EXPECT_GT(left / (f / (reduced * a)), 2 / std::numbers::pi);
  EXPECT_LT(left / (f / (reduced * a)), 0.75);
  EXPECT_GT(h.value(top, "scanner/z"), 5 * left);  // the dent
}

}  // namespace
}  // namespace pulvis
