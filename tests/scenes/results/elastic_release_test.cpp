// How much of the elastic response is that of contact springs: against springs in series, and against the slope of the
// same powder between stiffer ones, in a periodic cell and in three dimensions.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "scenes/results/run_quality.hpp"
#include "scenes/spec/elastic_response.hpp"
#include "tests/helpers/experiment.hpp"

namespace pulvis {
namespace {

// A particle of stiffness 3 and a contact of stiffness 2, pressed with friction that keeps 0.5 J in the particle: the
// contact has 3/5 of the compliance.
TEST(ElasticRelease, IsTheShareOfTheComplianceOfSpringsInSeries) {
  ElasticRelease release;
  const auto at = [&](double force) {
    release.sample(force, 0.5 + force * force / (2 * 3.0), force * force / (2 * 2.0));
  };
  for (const double force : {0.0, 1.0, 3.0, 2.9, 5.0, 8.0}) at(force);
  EXPECT_FALSE(release.share());  // 2.9 after 3 was no unloading
  for (const double force : {6.0, 0.5, 4.0}) at(force);
  ASSERT_TRUE(release.share());
  EXPECT_NEAR(*release.share(), 3.0 / 5, 1e-12);
  for (const double force : {7.0, 9.0}) at(force);  // to a new peak: what was released remains so
  EXPECT_NEAR(*release.share(), 3.0 / 5, 1e-12);
}

struct Unloaded {
  double slope;  // of the unloading: the load that vanishes over the way back
  double share;  // of the release that was in springs
};

// From the last sample of pressing to the end of the run.
Unloaded unload(Experiment& e, double end_of_pressing, const auto& load, const auto& place) {
  double load_before = 0, place_before = 0;
  e.run(200, [&] {
    if (e.simulation.clock().time > end_of_pressing * (1 + 1e-9)) return;
    load_before = load();
    place_before = place();
  });
  const auto share = e.results.released_by_springs();
  EXPECT_TRUE(share);
  return {(load_before - load()) / (place() - place_before), share.value_or(0)};
}

constexpr const char* cell_of_a_disc = R"(family = "compaction"
accuracy = "standard"
[[material]]
name = "soft-steel"
density = "7990 kg/m^3"
youngs_modulus = "100 GPa"
poissons_ratio = 0.3
yield_stress = "150 MPa"
hardening_modulus = "600 MPa"
[[particle]]
name = "disc"
material = "soft-steel"
outline = "disc"
diameter = "10 mm"
[cell]
width = "10 mm"
height = "10 mm"
[[body]]
particle = "disc"
position = ["5 mm", "5 mm"]
[contact]
damping = 0.1
[[stage]]
name = "press"
kind = "compact"
duration = "1 ms"
[stage.cell]
strain_xx = -0.05
strain_yy = -0.05
[[stage]]
name = "back"
kind = "unload"
duration = "1 ms"
[stage.cell]
strain_xx = 0.0012
strain_yy = 0.0012
)";

Unloaded unloaded_cell(double stiffness) {
  Experiment e(own_scene(cell_of_a_disc, {fmt::format("contact.stiffness={}", stiffness)}));
  const Unloaded found = unload(
      e, 1e-3, [&] { return -e.value("cell/stress_yy"); },
      [&] { return e.value("cell/strain_yy"); });
  const auto figures =
      run_quality(e.scene, e.simulation.world(), e.results, ContactLoading(e.scene).findings());
  const auto told = std::ranges::find(figures, release_figure, &QualityFigure::name);
  EXPECT_NE(told, figures.end());
  EXPECT_EQ(told->value, found.share);
  EXPECT_EQ(told->beyond(), stiffness < stiff_contacts);
  return found;
}

// (1 - share) of the slope between rigid contacts: whatever the springs, the same is left when theirs is taken out.
TEST(ElasticRelease, SaysByHowMuchACellUnloadsTooSoftly) {
  const Unloaded soft = unloaded_cell(0.5), stiff = unloaded_cell(10);
  EXPECT_GT(soft.share, 0.25);
  EXPECT_LT(stiff.share, 0.1);
  EXPECT_LT(soft.slope, 0.75 * stiff.slope);
  const double rigid = stiff.slope / (1 - stiff.share);
  EXPECT_NEAR(soft.slope / (1 - soft.share) / rigid, 1, 0.05);
}

// A sphere pressed by a tenth of its diameter and released, so slowly that its slope is not one of waves.
Unloaded unloaded_sphere(double stiffness) {
  Experiment e("compaction-3d/one-sphere.toml",
               {fmt::format("contact.stiffness={}", stiffness), "accuracy=draft",
                "stage.press.duration=0.8 ms",
                "stage.press.move.top.displacement=[\"0 mm\", \"0 mm\", \"-1 mm\"]",
                "stage.release.duration=0.4 ms",
                "stage.release.move.top.displacement=[\"0 mm\", \"0 mm\", \"0.01 mm\"]"});
  return unload(
      e, 0.8e-3, [&] { return e.value("tool/top/force_z"); },
      [&] { return e.value("tool/top/position_z"); });
}

TEST(ElasticRelease, SaysByHowMuchASphereSpringsBackTooSoftly) {
  const Unloaded soft = unloaded_sphere(0.5), stiff = unloaded_sphere(10);
  EXPECT_GT(soft.share, 0.3);
  EXPECT_LT(soft.slope, 0.75 * stiff.slope);
  const double rigid = stiff.slope / (1 - stiff.share);
  EXPECT_NEAR(soft.slope / (1 - soft.share) / rigid, 1, 0.1);
}

}  // namespace
}  // namespace pulvis
