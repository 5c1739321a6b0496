// From an AFM's volts to friction: the truth of the shipped records comes back, the intervals hold what they say, and
// each input counts as the equations have it.
#include "cli/laboratory/volts/volts_reduction.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <random>

#include "cli/laboratory/lab_settings.hpp"
#include "tests/helpers/paths.hpp"
#include "tests/helpers/wrong.hpp"

namespace pulvis::volts {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

const fs::path lab_folder = fs::path(paths::source_dir()) / "scenes/lab";

Reduced reduced_from(const char* settings, const std::vector<std::string>& overrides = {}) {
  std::vector<std::string> all{"afm.draws=4000"};
  all.insert(all.end(), overrides.begin(), overrides.end());
  const lab::Settings s = lab::load_settings(lab_folder / settings, all).settings;
  WedgeLoops wedge;
  if (!s.wedge.loops.empty()) wedge.file = lab_folder / s.wedge.loops;
  wedge.known = {s.wedge.adhesion, s.wedge.slope_error, s.wedge.load_error};
  wedge.skip = s.wedge.skip;
  return reduce(s.volts, wedge, lab_folder, s.analysis.confidence);
}

const Quantity& quantity(const Reduced& reduced, const std::string& name) {
  return *std::ranges::find(reduced.result.quantities, name, &Quantity::name);
}

double share(const Reduced& reduced, const std::string& name, const std::string& group) {
  const auto at = std::ranges::find(reduced.groups, group) - reduced.groups.begin();
  return quantity(reduced, name).shares.at(static_cast<std::size_t>(at)).drawn;
}

nlohmann::json truth() {
  return nlohmann::json::parse(std::ifstream(lab_folder / "volts-truth.json"));
}

TEST(FromVolts, TheShippedRecordsGiveTheirTruthBackWithinTheIntervals) {
  const nlohmann::json known = truth();
  for (const char* settings : {"volts.toml", "volts-test-probe.toml"}) {
    const Reduced reduced = reduced_from(settings);
    for (const char* name : {"friction", "adhesion", "normal_sensitivity", "lateral_sensitivity"}) {
      const Quantity& q = quantity(reduced, name);
      EXPECT_LT(q.low, known[name].get<double>()) << settings << " " << name;
      EXPECT_GT(q.high, known[name].get<double>()) << settings << " " << name;
    }
    const Quantity& line = quantity(reduced, "adhesion_of_line");
    EXPECT_LT(line.low, known["adhesion"].get<double>());
    EXPECT_GT(line.high, known["adhesion"].get<double>());
  }
  EXPECT_LT(quantity(reduced_from("volts.toml"), "friction").error, 0.015 * 0.22);
}

TEST(FromVolts, DrawsAndLinearPropagationAgreeAndSharesAddUp) {
  for (const char* settings : {"volts.toml", "volts-test-probe.toml"}) {
    const Reduced reduced = reduced_from(settings, {"afm.draws=10000"});
    EXPECT_EQ(reduced.result.failed, 0);
    for (const Quantity& q : reduced.result.quantities) {
      EXPECT_NEAR(q.error / q.linear, 1, 0.03) << settings << " " << q.name;
      double drawn = 0, linear = 0;
      for (const Share& one : q.shares) {
        drawn += one.drawn, linear += one.linear;
        EXPECT_NEAR(one.drawn, one.linear, 0.04) << settings << " " << q.name;
      }
      EXPECT_NEAR(drawn, 1, 0.06) << settings << " " << q.name;
      EXPECT_NEAR(linear, 1, 1e-12) << settings << " " << q.name;
    }
  }
}

// F/V = k_l h q_t/(q r S_t h_t) and F_n/V = k_n/S: their relative variances add.
TEST(FromVolts, ATestProbesUncertaintyIsThatOfAProduct) {
  const Reduced reduced = reduced_from("volts-test-probe.toml");
  const lab::Mean side = *reduced.measured.side, slope = reduced.measured.hard.slope;
  const double lateral2 = 0.04 * 0.04 + 4 * 0.01 * 0.01 + std::pow(side.error / side.value, 2);
  const double normal2 = 0.04 * 0.04 + 0.01 * 0.01 + std::pow(slope.error / slope.value, 2);
  const Quantity& lateral = quantity(reduced, "lateral_sensitivity");
  EXPECT_NEAR(lateral.linear / lateral.value / std::sqrt(lateral2), 1, 1e-4);
  const Quantity& normal = quantity(reduced, "normal_sensitivity");
  EXPECT_NEAR(normal.linear / normal.value / std::sqrt(normal2), 1, 1e-4);
  const nlohmann::json t = truth();
  const double by_hand =
      0.98 * t["k_l"].get<double>() * 1.004 * t["arm"].get<double>() /
      (t["share_twist"].get<double>() * side.value * t["probe_arm"].get<double>());
  EXPECT_NEAR(lateral.value / by_hand, 1, 1e-12);
}

// The force on the wedge and that on the sample are told by the same normal calibration: friction is a ratio.
TEST(FromVolts, ByLoopsOnSlopesTheNormalStiffnessDoesNotCountForFriction) {
  const Reduced one = reduced_from("volts.toml"),
                other = reduced_from("volts.toml", {"lever.k_n=0.4 N/m"});
  const double ratio = 0.4 / 0.3296;
  EXPECT_NEAR(quantity(other, "friction").value / quantity(one, "friction").value, 1, 1e-9);
  EXPECT_NEAR(quantity(other, "adhesion").value / quantity(one, "adhesion").value, ratio, 1e-9);
  EXPECT_NEAR(
      quantity(other, "lateral_sensitivity").value / quantity(one, "lateral_sensitivity").value,
      ratio, 1e-9);
  EXPECT_EQ(share(one, "friction", "normal stiffness"), 0);
  EXPECT_GT(share(one, "adhesion", "normal stiffness"), 0.5);
  const Reduced probe = reduced_from("volts-test-probe.toml");
  EXPECT_GT(share(probe, "friction", "normal stiffness"), 0.3);
  const Reduced tilted = reduced_from("volts.toml", {"lever.tilt=20 deg"});
  EXPECT_NEAR(quantity(tilted, "adhesion").value / quantity(one, "adhesion").value,
              1 / std::pow(std::cos(20 * std::numbers::pi / 180), 2), 1e-9);
}

// A shift of all loads moves the line, not its slope: A goes with it, volt by volt of the normal calibration.
TEST(FromVolts, TheFreeLevelCountsForAdhesionAlone) {
  const Reduced one = reduced_from("volts.toml", {"afm.level_error=20 mV"});
  EXPECT_EQ(share(one, "friction", "free level of the loops"), 0);
  const Quantity& line = quantity(one, "adhesion_of_line");
  const double shift = 0.02 * quantity(one, "normal_sensitivity").value;
  EXPECT_NEAR(share(one, "adhesion_of_line", "free level of the loops") * line.error * line.error /
                  (shift * shift),
              1, 0.1);
}

TEST(FromVolts, CrosstalkIsFoundAndRemoved) {
  const Reduced found = reduced_from("volts.toml");
  const double true_friction = truth()["friction"], true_crosstalk = truth()["crosstalk"];
  EXPECT_LT(std::abs(found.measured.crosstalk->value - true_crosstalk),
            3 * found.measured.crosstalk->error);
  const Reduced given = reduced_from(
      "volts.toml",
      {"crosstalk.method=given", fmt::format("crosstalk.coefficient={}", true_crosstalk)});
  EXPECT_NEAR(quantity(given, "friction").value, true_friction,
              3 * quantity(given, "friction").error);
  const Reduced left = reduced_from("volts.toml", {"crosstalk.method=none"});
  EXPECT_GT(std::abs(quantity(left, "friction").value - true_friction),
            5 * quantity(found, "friction").error);
  // It shows: both slopes contradict each other, and that is the uncertainty then.
  EXPECT_GT(share(left, "friction", "slopes that disagree"), 0.9);
}

TEST(FromVolts, TheSameSeedGivesTheSameDraws) {
  const std::vector<std::string> few{"afm.draws=1000"}, other{"afm.draws=1000", "afm.seed=2"};
  const Quantity a = quantity(reduced_from("volts.toml", few), "friction"),
                 b = quantity(reduced_from("volts.toml", few), "friction"),
                 c = quantity(reduced_from("volts.toml", other), "friction");
  EXPECT_EQ(a.error, b.error);
  EXPECT_EQ(a.low, b.low);
  EXPECT_NE(a.error, c.error);
}

TEST(Deviates, AreNormalAndIndependent) {
  Deviates one(1, 0), other(1, 1);
  double mean = 0, square = 0, fourth = 0, product = 0;
  constexpr int count = 200000;
  for (int i = 0; i < count; ++i) {
    const double x = one.next(), y = other.next();
    mean += x / count, square += x * x / count, fourth += x * x * x * x / count;
    product += x * y / count;
  }
  EXPECT_NEAR(mean, 0, 0.01);
  EXPECT_NEAR(square, 1, 0.015);
  EXPECT_NEAR(fourth, 3, 0.1);
  EXPECT_NEAR(product, 0, 0.01);
}

// An experiment in memory: loops in volts on two slopes and on the sample, with noise.
struct Experiment {
  double k_n = 0.3, slope = 1.2e7, lateral = 200e-9, friction = 0.25, adhesion = 15e-9;
  double noise = 4e-4, k_error = 0.05, pull_error = 0.01;

  Measured measured(std::mt19937& random) const {
    std::normal_distribution<double> normal(0, 1);
    const double force = k_n / slope;
    Measured m;
    m.lever.k_n = k_n * (1 + k_error * normal(random));
    m.hard.slope = {slope * (1 + 0.004 * normal(random)), 0.004 * slope};
    m.sample.pull_off = {adhesion / force + pull_error * normal(random), pull_error};
    m.wedge.emplace();
    const auto add = [&](LoopRecord& record, double angle, double load, double mu) {
      const double s = std::sin(angle), c = std::cos(angle), d = c * c - mu * mu * s * s;
      const double l = load * force;
      VoltsLoop loop;
      loop.slope = angle;
      loop.load = load;
      loop.half_width = mu * (l + adhesion * c) / d / lateral + noise * normal(random);
      loop.offset = ((1 + mu * mu) * l * s * c + mu * mu * adhesion * s) / d / lateral +
                    noise * normal(random);
      loop.half_width_error = loop.offset_error = noise;
      record.loops.push_back(loop);
    };
    for (const double angle : {0.25, -0.22})
      for (const double load : {1.0, 3.0, 5.0, 7.0}) add(*m.wedge, angle, load, 0.15);
    for (const double load : {1.0, 2.5, 4.0, 5.5, 7.0}) add(m.loops, 0, load, friction);
    return m;
  }
};

// Two hundred experiments: the intervals of 95 % hold the truth in about as many of a hundred.
TEST(FromVolts, TheIntervalsCoverTheTruth) {
  const Experiment truth_;
  VoltsSpec spec;
  spec.lever.k_n_error = truth_.k_error;
  std::mt19937 random(3);
  constexpr int experiments = 200;
  int friction = 0, adhesion = 0, lateral = 0;
  for (int e = 0; e < experiments; ++e) {
    const MonteCarlo all = propagate(Model(truth_.measured(random), spec), {1000, 1, 0.95, false});
    const auto covers = [&](const char* name, double value) {
      const auto q = std::ranges::find(all.quantities, name, &Quantity::name);
      return q->low <= value && value <= q->high;
    };
    friction += covers("friction", truth_.friction);
    adhesion += covers("adhesion", truth_.adhesion);
    lateral += covers("lateral_sensitivity", truth_.lateral);
  }
  // Three standard deviations of the count are 9; scatter above what is stated widens an interval, never narrows it.
  for (const int covered : {friction, adhesion, lateral}) {
    EXPECT_GE(covered, 181);
    EXPECT_LE(covered, 200);
  }
  EXPECT_LT(adhesion, 200);
}

class WrongVolts : public ::testing::Test {
 protected:
  WrongVolts() {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    place = fs::temp_directory_path() / fmt::format("pulvis-volts-{}-{}", getpid(), test->name());
    fs::create_directories(place);
    for (const auto& entry : fs::directory_iterator(lab_folder))
      if (entry.path().filename().string().starts_with("volts"))
        fs::copy(entry.path(), place / entry.path().filename());
  }
  ~WrongVolts() override { fs::remove_all(place); }

  std::string message(const std::vector<std::string>& overrides,
                      const char* settings = "volts.toml") {
    return message_of([&] {
      const lab::Settings s = lab::load_settings(place / settings, overrides).settings;
      WedgeLoops wedge{s.wedge.loops.empty() ? fs::path() : place / s.wedge.loops,
                       {0, s.wedge.slope_error, 0},
                       s.wedge.skip};
      reduce(s.volts, wedge, place, 0.95);
    });
  }
  std::string with_file(const char* name, const std::string& text, const std::string& key,
                        const char* settings = "volts.toml") {
    std::ofstream(place / name) << text;
    return message({key + "=" + name}, settings);
  }
  fs::path place;
};

TEST_F(WrongVolts, SettingsAreRefusedWithTheirKey) {
  EXPECT_THAT(message({"lever.k_n_error=0.5"}), HasSubstr("lever.k_n_error"));
  EXPECT_THAT(message({"lever.k_l=1 N"}), HasSubstr("lever.k_l"));
  EXPECT_THAT(message({"lever.calibration=volts-lever.json"}),
              HasSubstr("is given together with `lever.calibration`"));
  EXPECT_THAT(message({"afm.draws=10"}), HasSubstr(">= 1000"));
  EXPECT_THAT(message({"afm.lateral=test_probe"}),
              HasSubstr("test_probe.contacts: is missing, allowed: a file"));
  EXPECT_THAT(message({"afm.lateral=test_probe"}), HasSubstr("lever.k_l: is missing"));
  EXPECT_THAT(message({"force_curves.from=0.9"}),
              HasSubstr("force_curves.until: 0.95 leaves no line above 0.9, allowed: >= 1"));
  EXPECT_THAT(message({"crosstalk.method=given"}), HasSubstr("crosstalk.coefficient"));
  EXPECT_THAT(message({"wedge.slope_error=0.9 rad"}),
              HasSubstr("draws give no valid friction, allowed"));
}

TEST_F(WrongVolts, MissingFilesAndTables) {
  std::ofstream(place / "bare.toml") << "[afm]\nloops = \"volts-loops.csv\"\n";
  const std::string bare = message({}, "bare.toml");
  EXPECT_THAT(bare,
              HasSubstr("bare.toml:1:1: force_curves.hard: is missing, allowed: force curves"));
  EXPECT_THAT(bare, HasSubstr("wedge.loops: is missing"));
  EXPECT_THAT(bare, HasSubstr("lever.k_n_error: is missing"));
  std::ofstream(place / "curves.toml") << "[force_curves]\nhard = \"volts-hard.csv\"\n";
  EXPECT_THAT(message({}, "curves.toml"), HasSubstr("afm.loops: is missing"));
}

TEST_F(WrongVolts, RecordsAreRefusedWithTheirLine) {
  const std::string key = "afm.loops";
  EXPECT_THAT(with_file("l.csv", "load [m],half_width [V],offset [V]\n1,1,1\n", key),
              HasSubstr("has the unit 'm', allowed: V"));
  EXPECT_THAT(with_file("l.csv", "slope [deg],load [V],half_width [V],offset [V]\n0,1,1,1\n", key),
              HasSubstr("loops on slopes belong in wedge.loops"));
  EXPECT_THAT(with_file("l.csv", "load [V],half_width [V],offset [V]\n1,1,1\n2,2,2\n", key),
              HasSubstr("half_width_error"));
  EXPECT_THAT(with_file("l.csv", "load [V],forth [V],back [V]\n1,1,0\n", key),
              HasSubstr("forth: is called 'trace' now, allowed: trace"));
  EXPECT_THAT(with_file("l.csv", "load [V],trace [V],retrace [V],normal_trace [V]\n1,1,1,1\n", key),
              HasSubstr("normal_trace: is given alone"));
  EXPECT_THAT(with_file("l.csv", "load [V],trace [V],retrace [V]\n1,1,0\n1,1,0\n", key),
              HasSubstr("l.csv:3:"));
  const std::string hard = "force_curves.hard";
  EXPECT_THAT(with_file("h.csv", "displacement [nm],normal [V]\n0,0\n1,0\n", hard),
              HasSubstr("h.csv:3:"));
  std::string stops = "displacement [nm],normal [V]\n";
  for (int i = 0; i < 40; ++i) stops += fmt::format("{},0\n", i == 20 ? 19 : i);
  EXPECT_THAT(with_file("h.csv", stops, hard),
              HasSubstr("h.csv:22:1: displacement: 1.9e-08 m does not continue"));
  EXPECT_THAT(with_file("h.csv", "displacement [V],normal [V]\n0,0\n", hard),
              HasSubstr("displacement"));
}

TEST_F(WrongVolts, ASummaryWithoutACalibrationIsRefused) {
  const char* settings = "volts-test-probe.toml";
  EXPECT_THAT(with_file("s.json", "{", "lever.calibration", settings),
              HasSubstr("s.json:1:1: lever.calibration: is not JSON"));
  EXPECT_THAT(with_file("s.json", "{}", "lever.calibration", settings),
              HasSubstr("holds no calibration of a lever"));
  EXPECT_THAT(with_file("s.json", R"({"calibration": {"k_n": -1}})", "lever.calibration", settings),
              HasSubstr("no calibration/k_n above zero"));
  EXPECT_THAT(message({"lever.calibration=nowhere.json"}, settings), HasSubstr("nowhere.json"));
}

TEST_F(WrongVolts, LoopsThatFitNoFrictionAreRefused) {
  std::string text = "slope [deg],load [V],half_width [V],offset [V]\n";
  for (const double slope : {14.0, -12.5})
    for (int i = 1; i < 5; ++i)
      text += fmt::format("{},{},{},{}\n", slope, i, 0.1 * i + 0.001 * (i % 2), 0.001 * i);
  EXPECT_THAT(with_file("w.csv", text, "wedge.loops"),
              HasSubstr("there is no matching friction coefficient"));
}

}  // namespace
}  // namespace pulvis::volts
