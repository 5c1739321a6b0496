// What `pulvis check` expects of a run, held against the run: when stages come to rest, at which density, and how many steps it
// takes. (How long they take depends on the machine: docs/performance.md.)
#include "cli/preview/estimate.hpp"

#include <gmock/gmock.h>

#include "components/run_state.hpp"
#include "scenes/packing/place.hpp"
#include "scenes/read.hpp"
#include "scenes/results/results.hpp"
#include "tests/helpers/paths.hpp"

namespace pulvis {
namespace {

using ::testing::HasSubstr;

struct Told {
  Scene scene;
  std::vector<BodySpec> bodies;
  std::vector<StageForecast> stages;

  Told(const std::string& name, const std::vector<std::string>& changes)
      : scene(read_scene(paths::source_dir() + "/scenes/" + name, changes)),
        bodies(place_bodies(scene)),
        stages(stage_forecast(scene, bodies)) {}
};

// At constant speed but for its ramps, a tool comes to rest at a density when its way says so.
void expect_rest(const Told& told, double density) {
  ASSERT_FALSE(told.stages.empty());
  const StageForecast& first = told.stages.front();
  EXPECT_TRUE(first.is_known);
  EXPECT_LT(first.duration, told.scene.stages.front().duration);
  ASSERT_TRUE(first.ends);
  EXPECT_NEAR(*first.ends, density, 1e-9);

  Simulation simulation(told.scene);
  simulation.run_until(told.scene.stages.front().duration, [&] {
    return simulation.world().resource<ToolProgram>().stage_at(simulation.clock().time) > 0;
  });
  EXPECT_NEAR(simulation.clock().time, first.duration, 2 * simulation.clock().dt);
  simulation.observe();
  Results results(told.scene, simulation.whole());
  results.sample();
  EXPECT_NEAR(results.value("relative_density"), density, 1e-4);
}

TEST(StageForecast, APunchComesToRestAtItsDensityWhenItSays) {
  expect_rest(Told("compaction/unit-cell.toml", {"stage.press.until.relative_density=0.81"}), 0.81);
}

TEST(StageForecast, ACellComesToRestAtItsDensityWhenItSays) {
  expect_rest(Told("periodic/square.toml", {"stage.press.until.relative_density=0.8"}), 0.8);
}

TEST(StageForecast, SaysItInWords) {
  const Told told("compaction/unit-cell.toml", {"stage.press.until.relative_density=0.81"});
  EXPECT_THAT(stages_text(told.scene, told.stages),
              HasSubstr("relative density at rest: press 0.81 after 349 us of "));
}

// A force may be reached at any time: until then nothing is known.
TEST(StageForecast, KnowsNothingOfForces) {
  const Told told("compaction/unit-cell.toml",
                  {"stage.press.until.tool=top", "stage.press.until.force=1 kN"});
  EXPECT_FALSE(told.stages.front().is_known);
  EXPECT_FALSE(told.stages.front().ends);
  Simulation simulation(told.scene);
  EXPECT_TRUE(estimate_run(simulation, told.scene, told.bodies.size(), told.stages).is_most);
}

TEST(RunEstimate, TellsTheNumberOfSteps) {
  for (const char* name : {"compaction/unit-cell.toml", "periodic/square.toml"}) {
    const Told told(name, {});
    Simulation estimated(told.scene), simulation(told.scene);
    const double steps = estimate_run(estimated, told.scene, 1, told.stages).steps;
    simulation.run_until(simulation.clock().end);
    EXPECT_NEAR(steps / static_cast<double>(simulation.clock().step), 1, 0.2) << name;
  }
}

}  // namespace
}  // namespace pulvis
