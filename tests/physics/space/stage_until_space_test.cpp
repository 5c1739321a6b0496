// Stages in three dimensions end at the relative density of their `until`, where the tools have come to rest.
#include <gtest/gtest.h>

#include "tests/helpers/experiment.hpp"

namespace pulvis {
namespace {

// They end within one step: 5e-4 at the speeds of these presses.
constexpr double of_a_step = 1e-3;

double density_at_end(Experiment& e) {
  while (!e.simulation.finished()) e.simulation.run_steps(1);
  e.simulation.observe();
  e.results.sample();
  return e.value("relative_density");
}

// Six planes close in, the first by a ramp of its own.
TEST(StageUntilInSpace, ABoxEndsAtItsDensity) {
  for (const char* ramp : {"0.1", "0.4"}) {
    Experiment e("compaction-3d/unit-cell-sc.toml",
                 {"particle.ball.mesh.divisions=2", "particle.ball.mesh.rings=1", "let.move=1 mm",
                  "stage.press.until.relative_density=0.75", "stage.press.duration=0.1 ms",
                  std::string("stage.press.move.left.ramp=") + ramp});
    EXPECT_NEAR(density_at_end(e), 0.75, of_a_step) << ramp;
  }
}

// Both punches of a round die move, at different speeds.
TEST(StageUntilInSpace, ARoundDieEndsAtItsDensity) {
  Experiment e(
      own_scene("extends = \"compaction-3d/tablet.toml\"\n"
                "remove = [\"stage.unload\", \"stage.eject\", \"stage.free\"]\n",
                {"packing[0].density=0.4", "packing[0].class[0].number=12",
                 "particle.granule.mesh.divisions=2", "particle.granule.mesh.rings=1",
                 "stage.press.duration=0.2 ms", "stage.press.until.relative_density=0.5",
                 "stage.press.move.top.displacement=[\"0 mm\", \"0 mm\", \"-2 mm\"]",
                 "stage.press.move.bottom.displacement=[\"0 mm\", \"0 mm\", \"5 mm\"]"}));
  EXPECT_NEAR(density_at_end(e), 0.5, of_a_step);
}

}  // namespace
}  // namespace pulvis
