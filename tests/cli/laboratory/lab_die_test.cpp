// The balance of a slice: synthetic records of an instrumented die give back friction and stress ratio, and so does a
// simulated compaction whose friction is known.
#include "cli/laboratory/lab_die.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/helpers/paths.hpp"
#include "tests/helpers/program.hpp"
#include "tests/helpers/wrong.hpp"

namespace pulvis::lab {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

const fs::path die_folder = fs::path(paths::source_dir()) / "scenes/lab";

std::vector<SliceStep> steps_of(const char* settings_file,
                                const std::vector<std::string>& more = {}) {
  const Settings settings = load_settings(die_folder / settings_file, more).settings;
  const TransmissionSpec& spec = settings.transmissions.front();
  const DieRecord record = read_die(die_folder / spec.record, settings);
  return slice_steps(die_curve(record, spec, settings, machine_of(settings)), settings, true);
}

double truth_at(const nlohmann::json& law, double density) {
  return law["value"].get<double>() +
         law["slope"].get<double>() * (density - law["at"].get<double>());
}

// Of intervals of 95%, at most three in 26 may miss (in 99 of 100 sets).
void expect_truth(const std::vector<SliceStep>& steps, double widest) {
  std::ifstream file(die_folder / "die-truth.json");
  const auto truth = nlohmann::json::parse(file);
  int missed = 0;
  EXPECT_GE(steps.size(), 12u);
  for (const SliceStep& step : steps) {
    const double k = truth_at(truth["stress_ratio"], step.density);
    const double mu = truth_at(truth["friction"], step.density);
    missed += std::abs(step.stress_ratio.value - k) > step.stress_ratio.half_width(0.95);
    missed += std::abs(step.friction.value - mu) > step.friction.half_width(0.95);
    EXPECT_NEAR(step.stress_ratio.value, k, widest * k) << step.density;
    EXPECT_NEAR(step.friction.value, mu, widest * mu) << step.density;
  }
  EXPECT_LE(missed, 3);
}

TEST(LabDie, RoundDieWithAGaugeGivesFrictionAndRatioBack) {
  expect_truth(steps_of("die.toml", {"gauges.top_error=0", "gauges.bottom_error=0",
                                     "gauges.radial_error=0", "die.height_error=0 mm"}),
               0.02);
}

TEST(LabDie, AGaugeAboveTheCompactAndADensityAboveOneAreRefused) {
  EXPECT_THAT(message_of([] { steps_of("die.toml", {"gauges.radial_height=30 mm"}); }),
              HasSubstr("gauges.radial_height: 30 mm is above the compact"));
  EXPECT_THAT(message_of([] { steps_of("die.toml", {"transmission[0].mass=132 g"}); }),
              HasSubstr("check mass, die.solid_density"));
}

TEST(LabDie, SlotWithItsMeanWallStressToo) { expect_truth(steps_of("slot.toml"), 0.02); }

// A cell that is 1% wrong moves the loss, and with it the friction, by 1% of sigma_t/sigma_b: far more than its scatter.
TEST(LabDie, ErrorsOfForceCellsGoIntoTheFriction) {
  const std::vector<SliceStep> steps = steps_of("die.toml", {"gauges.top_error=0.01"});
  for (const SliceStep& step : steps) {
    const auto& of = step.friction.contributions;
    const auto top = std::ranges::find(of, "top", &Contribution::source);
    ASSERT_NE(top, of.end());
    const double loss = std::log(step.top / step.bottom);
    EXPECT_GT(top->error, 0.3 * 0.00995 / loss * step.friction.value);
    EXPECT_LT(top->error, 3 * 0.00995 / loss * step.friction.value);
    EXPECT_GT(step.friction.half_width(0.95), 1.9 * top->error);
  }
}

// Without loss of force the axial stress is the punch's, and there is no friction.
TEST(LabDie, NoLossIsNoFriction) {
  DieCurve die{"a", {}, {}, {}, {}, {}, 3.75e-3, {}, {}};
  for (int i = 0; i <= 20; ++i) {
    die.density.push_back(0.7 + 1e-4 * i);
    die.top.push_back(1e8);
    die.bottom.push_back(1e8);
    die.radial.push_back(4e7);
    die.height.push_back(0.01);
  }
  const auto steps = slice_steps(die, load_settings(die_folder / "slot.toml", {}).settings, false);
  ASSERT_EQ(steps.size(), 1u);
  EXPECT_NEAR(steps[0].stress_ratio.value, 0.4, 1e-12);
  EXPECT_NEAR(steps[0].friction.value, 0, 1e-12);
}

class LabDieOfARun : public ProgramTest {};

// 25 discs between walls of a coefficient of 0.1: once all touch the walls they slide there, and the balance gives it
// back, though it knows nothing of the scene.
TEST_F(LabDieOfARun, GivesTheFrictionOfTheScene) {
  const std::string scene = std::string(paths::source_dir()) + "/scenes/compaction/regular-25.toml";
  ASSERT_EQ(pulvis({"run", scene, "-o", "r25", "--threads", "1"}).code, 0);
  const DieCurve die = simulated_die(place / "r25");
  EXPECT_EQ(die.friction, 0.1);
  EXPECT_NEAR(die.wall_length, 25e-3, 1e-9);
  int compared = 0;
  for (const SliceStep& step :
       slice_steps(die, load_settings(die_folder / "slot.toml", {}).settings, false)) {
    if (step.density < 0.81 || step.density > 0.865) continue;  // all touch; the punch still moves
    EXPECT_NEAR(step.friction.value, 0.1, 0.002) << step.density;
    EXPECT_GT(step.stress_ratio.value, 0.45) << step.density;
    EXPECT_LT(step.stress_ratio.value, 0.60) << step.density;
    ++compared;
  }
  EXPECT_GE(compared, 3);
  EXPECT_THAT(message_of([&] { simulated_die(place / "none"); }), HasSubstr("none"));
}

}  // namespace
}  // namespace pulvis::lab
