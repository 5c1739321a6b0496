// pulvis fit as a user meets it: a known friction is found again, what was done is kept, and what cannot be compared is
// said or refused.
#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>

#include "cli/campaigns/fit/plate_comparison.hpp"
#include "cli/laboratory/output/lab_output.hpp"
#include "tests/helpers/paths.hpp"
#include "tests/helpers/program.hpp"
#include "tests/helpers/wrong.hpp"

namespace pulvis {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

const fs::path sources = paths::source_dir();

// Four discs on a plate.
const std::string four_discs =
    "extends = \"" + (sources / "scenes/shear/flat-16.toml").string() + R"("
remove = ["expect"]

[[packing]]
kind = "square"
particle = "disc"
rows = 2
columns = 2

[[tool]]
name = "right"
point = ["20 mm", "0 mm"]

[[tool]]
name = "top"
point = ["0 mm", "20 mm"]

[[stage]]
name = "load"
servo = [{ tool = "top", force = "4 kN", rise = 0.8 }]

[[stage]]
name = "shear"
servo = [{ tool = "top", force = "4 kN" }]

[[friction]]
between = ["316L", "target"]
coefficient = 0.2
)";
// 30 rows from `first` mm on, a millimetre apart.
std::string steady_rows(int first) {
  std::string rows;
  for (int i = 0; i < 30; ++i) rows += std::to_string(first + i) + ",0.2\n";
  return rows;
}
const std::string one_key = R"(scene = "plate.toml"

[[parameter]]
key = "friction[0].coefficient"
start = 0.15
low = 0.0
high = 0.5
step = 0.02

[measured]
record = "measured.csv"
from = "1 mm"
)";

class FitCommand : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    write("plate.toml", four_discs);
    write("fit.toml", one_key);
  }
  void write(const char* name, const std::string& text) const {
    std::ofstream(place / name) << text;
  }
  // The friction of a run, with noise.
  void record(const fs::path& run, double noise, double scale = 1) const {
    const lab::SimulatedCurve curve = lab::read_simulation(run, "target");
    std::mt19937 source(5);
    std::normal_distribution<double> normal(0, noise);
    std::ofstream file(place / "measured.csv");
    file << "distance [m],friction\n";
    for (std::size_t i = 0; i < curve.distance.size(); ++i)
      file << scale * curve.distance[i] << ',' << curve.friction[i] + normal(source) << '\n';
  }
  std::string refusal() const {
    return message_of([&] { PlateComparison(load_plate_fit(place / "fit.toml")); });
  }
};

TEST_F(FitCommand, FindsAKnownFrictionAgainAndKeepsItsRuns) {
  const Words truth{"run",       "plate.toml", "-o",    "truth",
                    "--threads", "1",          "--set", "friction[0].coefficient=0.23"};
  ASSERT_EQ(pulvis(truth).code, 0);
  record(place / "truth", 0.002);
  const Words words{"fit", "fit.toml", "-o", "fitted", "--jobs", "2"};
  const Outcome outcome = pulvis(words);
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto json = nlohmann::json::parse(text_of(place / "fitted/fit.json"));
  EXPECT_EQ(json["state"], "converged");
  const double found = json["parameters"][0]["value"], half = json["parameters"][0]["half_width"];
  EXPECT_NEAR(found, 0.23, half);
  EXPECT_GT(half, 1e-4);
  EXPECT_LT(half, 2e-3);
  EXPECT_NEAR(json["misfit_rms"], 0.002, 0.0005);
  EXPECT_THAT(outcome.out, HasSubstr("No simulated particle has moved by its own diameter"));
  EXPECT_THAT(text_of(place / "fitted/report.html"), HasSubstr("Misfit of all runs"));
  const Outcome again = pulvis(words);
  EXPECT_EQ(again.code, 0);
  EXPECT_THAT(again.out, HasSubstr("0 to do"));
  EXPECT_THAT(again.out, Not(HasSubstr("[1/")));
  EXPECT_EQ(nlohmann::json::parse(text_of(place / "fitted/fit.json")), json);
  // At equal multiples of the diameters: the same record of particles a hundred times smaller.
  record(place / "truth", 0.002, 0.01);
  write("fit.toml", one_key + "compare = \"diameters\"\nparticle_diameter = \"0.1 mm\"\n");
  const Outcome small = pulvis({"fit", "fit.toml", "-o", "fitted", "--jobs", "2"});
  EXPECT_EQ(small.code, 0) << small.err;
  EXPECT_THAT(small.out, HasSubstr("Compared at equal multiples of the diameters"));
  EXPECT_NEAR(nlohmann::json::parse(text_of(place / "fitted/fit.json"))["parameters"][0]["value"],
              0.23, half);
}

// A friction that rises: a static coefficient below the dynamic one is no scene, so both have the same value.
TEST_F(FitCommand, FollowsTheLimitOfValidScenes) {
  write("fit.toml", R"(scene = "plate.toml"
[[parameter]]
key = "friction[0].coefficient"
start = 0.15
low = 0.0
high = 0.5
step = 0.02
[[parameter]]
key = "friction[0].static_coefficient"
start = 0.2
low = 0.0
high = 0.6
step = 0.02
[measured]
static = 0.2
static_error = 0.01
dynamic = 0.26
dynamic_error = 0.01
[fit]
dynamic_from = "1 mm"
)");
  const Outcome outcome = pulvis({"fit", "fit.toml", "-o", "fitted", "--jobs", "2", "--set",
                                  "friction[0].decay_length=0.3 mm"});
  EXPECT_EQ(outcome.code, 0) << outcome.out << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("the best values are at the limit of valid scenes"));
  const auto json = nlohmann::json::parse(text_of(place / "fitted/fit.json"));
  EXPECT_NEAR(json["parameters"][0]["value"], 0.23, 0.01);
  EXPECT_NEAR(json["parameters"][0]["value"], json["parameters"][1]["value"], 1e-3);
}

// Folders of fits stand alone: scene, record and what --set changed lie in them.
TEST_F(FitCommand, AMovedFolderDoesTheSameAgain) {
  fs::create_directories(place / "given/records");
  fs::rename(place / "plate.toml", place / "given/plate.toml");
  std::string samples = "distance [mm],friction\n";
  for (int i = 0; i <= 40; ++i) samples += std::to_string(i * 0.1) + ",0.2\n";
  write("given/records/measured.csv", samples);
  std::string fit = one_key + "from = \"0 mm\"\n[fit]\nmax_rounds = 1\n";
  fit.replace(fit.find("measured.csv"), 12, "records/measured.csv");
  fit.erase(fit.find("from = \"1 mm\"\n"), 14);
  write("given/fit.toml", fit);
  const auto run = [&](const Words& words) { return pulvis(with(words, {"--jobs", "2"})); };
  const Outcome first =
      run({"fit", "given/fit.toml", "-o", "fitted", "--set", "contact.damping=0.2"});
  ASSERT_TRUE(fs::exists(place / "fitted/fit.json")) << first.out << first.err;
  fs::remove_all(place / "given");
  fs::rename(place / "fitted", place / "moved");
  const Outcome again = run({"fit", "moved/fit.toml", "-o", "again"});
  EXPECT_EQ(again.code, first.code) << again.out << again.err;
  EXPECT_EQ(text_of(place / "again/fit.json"), text_of(place / "moved/fit.json"));
}

TEST_F(FitCommand, RefusesWhatCannotBeSought) {
  write("measured.csv", "distance [mm],friction\n" + steady_rows(0));
  EXPECT_EQ(refusal(), "");
  write("fit.toml", one_key + "[fit]\ntarget = \"plate\"\n");
  EXPECT_THAT(refusal(), HasSubstr("fit.target: the scene has no tool 'plate'"));
  write("fit.toml", one_key + "static = 0.2\nstatic_error = 0.01\n");
  EXPECT_THAT(refusal(), HasSubstr("a record and coefficients are given, allowed: one of them"));
  write("fit.toml", one_key + "compare = \"diameters\"\n");
  EXPECT_THAT(refusal(), HasSubstr("measured.particle_diameter: is not given, allowed: > 0 m"));
  std::string other = one_key;
  other.replace(other.find("coefficient"), 11, "coefficent");
  write("fit.toml", other);
  EXPECT_THAT(refusal(), HasSubstr("unknown key"));
  other = one_key;
  other.replace(other.find("start = 0.15"), 12, "start = 0.75");
  write("fit.toml", other);
  EXPECT_THAT(refusal(), HasSubstr("parameter[0].start: 0.75, allowed: between 0 and 0.5"));
  EXPECT_EQ(pulvis({"fit", "fit.toml", "-o", "fitted"}).code, 2);
  EXPECT_FALSE(fs::exists(place / "fitted"));
}

// Runs are named after their values: a step must change the name.
TEST_F(FitCommand, SmallStepsGetMoreDigits) {
  const auto with_step = [&](const std::string& step) {
    std::string fit = one_key;
    fit.replace(fit.find("step = 0.02"), 11, "step = " + step);
    write("fit.toml", fit);
  };
  write("measured.csv", "distance [mm],friction\n0,0.1\n1,0.2\n");
  with_step("1e-7");
  const PlateFit read = load_plate_fit(place / "fit.toml");
  EXPECT_EQ(read.settings_at({0.2300001}).front(), "friction[0].coefficient=0.2300001");
  EXPECT_EQ(read.settings_at({0.23000001}).front(), "friction[0].coefficient=0.23000001");
  with_step("0.02");
  EXPECT_EQ(load_plate_fit(place / "fit.toml").settings_at({0.23000001}).front(),
            "friction[0].coefficient=0.23");
  with_step("1e-13");
  EXPECT_THAT(refusal(), HasSubstr("parameter[0].step: 1e-13, allowed: at least 5e-13"));
}

// A key without effect, and two that have the same effect in units that differ by many orders.
TEST_F(FitCommand, GivesNoIntervalToWhatItCannotDetermine) {
  write("measured.csv", "distance [mm],friction\n" + steady_rows(0));
  const std::string second = R"([[parameter]]
key = "limits.energy_balance"
start = 0.5
low = 0.3
high = 0.9
step = 0.02
[measured])";
  std::string fit = one_key;
  write("fit.toml", fit.replace(fit.find("[measured]"), 10, second));
  const PlateFit read = load_plate_fit(place / "fit.toml");
  const PlateComparison comparison(read);
  const Eigen::VectorXd ramp = Eigen::VectorXd::LinSpaced(50, 1, 2);
  const Eigen::VectorXd scatter = ramp.unaryExpr([](double x) { return 0.01 * std::cos(1e4 * x); });
  const auto with_slopes = [&](const Eigen::VectorXd& first, const Eigen::VectorXd& other) {
    Eigen::MatrixXd jacobian(50, 2);
    jacobian << first, other;
    return comparison.parameters({0.2, 0.5}, scatter, jacobian);
  };
  const auto without = with_slopes(ramp, 0 * ramp);
  EXPECT_TRUE(without[0].has_interval());
  EXPECT_FALSE(without[1].has_interval());
  EXPECT_TRUE(measured_json(without[1], 0.95).dump().find("\"half_width\":null") !=
              std::string::npos);
  EXPECT_EQ(measured_text(without[1], 0.95), "energy_balance 0.5 (no interval)");
  EXPECT_FALSE(measured_cell(without[1], 0.95).contains("error"));
  for (const lab::Measured& p : with_slopes(ramp, 1e-12 * ramp)) EXPECT_FALSE(p.has_interval());
  const auto apart = with_slopes(ramp, 1e-12 * ramp.cwiseAbs2());
  EXPECT_TRUE(apart[0].has_interval());
  EXPECT_NEAR(apart[1].standard() / with_slopes(ramp, ramp.cwiseAbs2())[1].standard(), 1e12, 1e6);
}

// It would be the same in all runs, whatever values the search asks for.
TEST_F(FitCommand, RefusesToReplaceAParameter) {
  const fs::path shipped = sources / "scenes/lab/plate-fit.toml";
  EXPECT_THAT(message_of([&] { load_plate_fit(shipped, {"friction[0].coefficient=0.15"}); }),
              HasSubstr("--set friction[0].coefficient=0.15: friction[0].coefficient: replaces the "
                        "fitted parameter 'friction[0].coefficient'"));
}

// Where the record has few samples within the simulated way nothing is compared.
TEST_F(FitCommand, RefusesARecordThatDoesNotReachTheSimulation) {
  write("measured.csv", "distance [mm],friction\n0,0.1\n1,0.2\n" + steady_rows(50));
  const PlateFit read = load_plate_fit(place / "fit.toml");
  PlateComparison comparison(read);
  EXPECT_NEAR(comparison.simulated_diameter(), 10e-3, 1e-5);
  EXPECT_THAT(message_of([&] {
                comparison.set_reach({"s", {0, 1e-3, 2e-3}, {0, 0.1, 0.1}});
              }),
              HasSubstr("1 of its samples lie between 1 and 2 mm, allowed: at least 20"));
}

TEST_F(FitCommand, RefusesARecordFromBeforeTheStart) {
  std::string samples = "distance [mm],friction\n";
  for (int i = 1; i <= 40; ++i) samples += std::to_string(-i) + ",0.2\n";
  write("measured.csv", samples);
  EXPECT_THAT(refusal(), HasSubstr("the compared range would end at 0 mm, allowed: beyond its"));
}

// Samples of a return stroke would be compared as if the plate still slid forward.
TEST_F(FitCommand, RefusesAReturnStrokeButNotNoise) {
  const auto rows = [](int first, int step, int count) {
    std::string text;
    for (int i = 0; i < count; ++i) text += std::to_string(first + i * step) + ",0.2\n";
    return text;
  };
  const std::string head = "distance [um],friction\n";
  write("measured.csv", head + rows(0, 100, 51) + rows(4850, -100, 30));
  EXPECT_THAT(refusal(),
              HasSubstr("measured.csv:53:1: distance: falls to 4.85 mm after 5 mm in line "
                        "52, allowed: a single forward stroke"));
  write("measured.csv", head + rows(0, 100, 51) + rows(0, 100, 51));  // a second stroke
  EXPECT_THAT(refusal(), HasSubstr("falls to 1 mm after 5 mm in line 52, allowed"));
  std::string noisy = head;  // falls by 90 um of 5 mm, and values that stay equal
  for (int i = 0; i < 50; ++i) noisy += rows(100 * i + (i % 2 ? 0 : 190), 0, 2);
  write("measured.csv", noisy);
  EXPECT_EQ(refusal(), "");
  // Beyond what is compared it does no harm.
  write("measured.csv", head + rows(0, 100, 51) + rows(4850, -100, 9));
  EXPECT_THAT(refusal(), HasSubstr("falls to 4.85 mm"));
  write("fit.toml", one_key + "until = \"4 mm\"\n");
  EXPECT_EQ(refusal(), "");
}

// As `mean` in curves.csv where only one run reaches.
TEST_F(FitCommand, LeavesOutRowsWithoutAValue) {
  write("measured.csv", "distance [mm],mean\n0,0.1\n1,0.2\n1.5,\n2,0.3\n9,\n" + steady_rows(10));
  write("fit.toml", one_key + "friction = \"mean\"\n");
  const PlateFit read = load_plate_fit(place / "fit.toml");
  const PlateComparison comparison(read);
  ASSERT_EQ(comparison.distance().size(), 33U);
  EXPECT_DOUBLE_EQ(comparison.distance()[2], 2e-3);
  EXPECT_DOUBLE_EQ(comparison.distance()[3], 10e-3);
  ASSERT_EQ(comparison.friction().size(), 33U);
  EXPECT_DOUBLE_EQ(comparison.friction()[2], 0.3);
  EXPECT_DOUBLE_EQ(comparison.friction()[3], 0.2);
}

TEST_F(FitCommand, RefusesSceneInThreeDimensions) {
  const std::string scene = (sources / "scenes/compaction-3d/one-sphere.toml").string();
  write("fit.toml", "scene = \"" + scene + R"("
[[parameter]]
key = "contact.friction"
start = 0.3
low = 0.1
high = 0.5
step = 0.02
[measured]
record = "measured.csv"
)");
  EXPECT_THAT(refusal(), HasSubstr("the scene is three-dimensional, allowed: two-dimensional"));
}

TEST_F(FitCommand, TheShippedFitAndItsReferenceAreWhole) {
  const PlateFit shipped = load_plate_fit(sources / "scenes/lab/plate-fit.toml");
  EXPECT_EQ(shipped.spec.parameters.size(), 2u);
  EXPECT_TRUE(PlateComparison(shipped).has_record());
  EXPECT_EQ(text_of(sources / "docs/fit.md"), plate_fit_reference());
}

}  // namespace
}  // namespace pulvis
