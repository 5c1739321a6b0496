// Stages that end early: where their tools are then, and when.
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "components/servo.hpp"
#include "engine/run_failure.hpp"
#include "tests/helpers/experiment.hpp"
#include "tests/helpers/right_scene.hpp"

namespace pulvis {
namespace {

using testing::AllOf;
using testing::HasSubstr;

// One disc in its die, pressed by 0.5 mm in 0.5 ms.
const std::vector<std::string> disc_in_its_die{
    "packing[0].rows=1",
    "packing[0].columns=1",
    "tool.right.point=[\"10 mm\", \"0 mm\"]",
    "tool.top.point=[\"0 mm\", \"10 mm\"]",
    "stage.press.duration=0.5 ms",
    "stage.press.move.top.displacement=[\"0 mm\", \"-0.5 mm\"]"};

Experiment pressed_until(const std::vector<std::string>& until) {
  std::vector<std::string> changes = disc_in_its_die;
  changes.insert(changes.end(), until.begin(), until.end());
  return Experiment("compaction/regular-25.toml", changes);
}

double end_after_running(Experiment& e) {
  while (!e.simulation.finished()) e.simulation.run_steps(1);
  e.simulation.observe();
  e.results.sample();
  return e.simulation.clock().time;
}

// The punch goes at 0.5 mm / 0.45 ms. It takes the 0.05 ms of its ramp to come to rest, and half of the way that it would
// go in them.
constexpr double pressing = 0.5e-3 / 0.45e-3, rest = 0.05e-3;

TEST(StageUntil, ADisplacementEndsItWhereTheToolHasComeToRest) {
  Experiment e =
      pressed_until({"stage.press.until.tool=top", "stage.press.until.displacement=0.2 mm"});
  const double end = end_after_running(e), in_a_step = pressing * e.simulation.clock().dt;
  EXPECT_NEAR(end, 0.025e-3 + 0.2e-3 / pressing + rest / 2, 2e-7);
  EXPECT_NEAR(0.01 - e.value("tool/top/position_y"), 0.2e-3, 2 * in_a_step);
  EXPECT_LT(std::abs(e.column<ToolVelocity>().values()[tool_axes * 3 + 1]), 1e-3);
}

struct Met {
  double time, step, top;
};
// Runs until `series` is at `bound` for the first time.
Met run_until(Experiment& e, const char* series, double bound) {
  do {
    e.simulation.run_steps(1);
    e.simulation.observe();
    e.results.sample();
  } while (e.value(series) < bound && !e.simulation.finished());
  return {e.simulation.clock().time, e.simulation.clock().dt, e.value("tool/top/position_y")};
}

// No powder tells in advance what it will bear: the punch begins to come to rest in the step that reaches the force.
TEST(StageUntil, AForceIsWhereTheToolBeginsToComeToRest) {
  Experiment e = pressed_until({"stage.press.until.tool=top", "stage.press.until.force=1 kN"});
  const Met met = run_until(e, "tool/top/force_y", 1000);
  EXPECT_NEAR(end_after_running(e), met.time + rest, 2 * met.step);
  EXPECT_NEAR(met.top - e.value("tool/top/position_y"), pressing * rest / 2,
              2 * pressing * met.step);
}

TEST(StageUntil, ADensityIsThatWhereTheToolHasComeToRest) {
  Experiment e = pressed_until({"stage.press.until.relative_density=0.8"});
  const double end = end_after_running(e);
  EXPECT_NEAR(e.value("relative_density"), 0.8, 2e-5);
  EXPECT_LT(end, 0.45e-3);
  EXPECT_LT(std::abs(e.column<ToolVelocity>().values()[tool_axes * 3 + 1]), 1e-3);
}

// While the speed of one falls already, the other can still be stopped.
TEST(StageUntil, EachMoveComesToRestByItsOwnRamp) {
  std::vector<std::string> changes = disc_in_its_die;
  changes.emplace_back("stage.press.until.relative_density=0.835");
  Experiment e(
      own_scene("extends = \"compaction/regular-25.toml\"\n[[stage]]\nname = \"press\"\n"
                "[[stage.move]]\ntool = \"bottom\"\ndisplacement = [\"0 mm\", \"0.2 mm\"]\n"
                "ramp = 0.5\n",
                changes));
  end_after_running(e);
  EXPECT_NEAR(e.value("relative_density"), 0.835, 2e-5);
  EXPECT_NEAR(e.value("tool/bottom/position_y"), 0.2e-3, 1e-9);
}

TEST(StageUntil, StopsTheRunWhenItsTimeIsOverBefore) {
  Experiment e = pressed_until({"stage.press.until.relative_density=1.1"});
  EXPECT_THAT(message_of<RunFailure>([&] { end_after_running(e); }),
              AllOf(HasSubstr("stage_control: relative density is 0.82"),
                    HasSubstr("stage 'press'"), HasSubstr("1.1")));
}

// A displacement that is the whole of the move is reached, however it rounds: the run goes to its end.
TEST(StageUntil, MayBeTheWholeOfItsMove) {
  for (const char* way : {"0.03 mm", "0.07 mm", "0.1 mm", "0.3 mm"}) {
    const std::string length = way;
    Experiment e =
        pressed_until({"stage.press.duration=60 us",
                       "stage.press.move[0].displacement=[\"0 mm\", \"-" + length + "\"]",
                       "stage.press.until.tool=top", "stage.press.until.displacement=" + length});
    EXPECT_NO_THROW(e.run(2)) << length;
  }
}

}  // namespace
}  // namespace pulvis
