// Records as files: the shipped synthetic ones give their truth back, and broken ones are refused with
// file and line, by the program with exit code 2.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "cli/laboratory/lab_simulation.hpp"
#include "tests/helpers/paths.hpp"
#include "tests/helpers/sliding_test.hpp"
#include "tests/helpers/wrong.hpp"

namespace pulvis::lab {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

const fs::path shipped = fs::path(paths::source_dir()) / "scenes/lab";

std::string text_of(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

nlohmann::json json_of(const fs::path& file) { return nlohmann::json::parse(text_of(file)); }

class LabRecords : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    place =
        fs::temp_directory_path() / ("pulvis-lab-" + std::to_string(getpid()) + "-" + test->name());
    fs::remove_all(place);
    fs::create_directories(place);
    press = text_of(shipped / "synthetic-press-1.csv");
    logger = text_of(shipped / "synthetic-logger-1.csv");
  }
  void TearDown() override { fs::remove_all(place); }

  fs::path write(const std::string& name, const std::string& text) const {
    std::ofstream(place / name) << text;
    return place / name;
  }

  // What is wrong with a record, without its folder.
  std::string press_refusal(const std::vector<std::string>& more = {}) const {
    const fs::path file = write("press.csv", press);
    return local(message_of([&] { read_press(file, settings_of(more)); }));
  }
  std::string logger_refusal(const std::vector<std::string>& more = {}) const {
    const fs::path file = write("logger.csv", logger);
    return local(message_of([&] { read_logger(file, settings_of(more)); }));
  }
  std::string local(const std::string& message) const {
    const std::string folder = place.string() + "/";
    return message.starts_with(folder) ? message.substr(folder.size()) : message;
  }

  int pulvis(const std::string& arguments) const {
    const std::string command =
        "cd '" + place.string() + "' && '" + paths::program() + "' " + arguments + " > out 2> err";
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  fs::path place;
  std::string press, logger;  // to be spoilt
};

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

void replace_first(std::string& text, const std::string& from, const std::string& to) {
  ASSERT_NE(text.find(from), std::string::npos) << from;
  text.replace(text.find(from), from.size(), to);
}

// ---- the shipped records

TEST_F(LabRecords, TheShippedOnesGiveTheirTruthBack) {
  ASSERT_EQ(pulvis("reduce '" + (shipped / "reduce.toml").string() + "' -o done"), 0)
      << text_of(place / "err");
  const auto truth = json_of(shipped / "truth.json"),
             summary = json_of(place / "done/summary.json");
  const double noise = 0.73 / 812 * 1.28;  // of the coefficient: 1 um/m over the target force
  for (std::size_t i = 0; i < 3; ++i) {
    const auto &made = truth["runs"][i], &run = summary["runs"][i];
    const double offset = made["press"].get<double>() - made["logger"].get<double>();
    EXPECT_NEAR(run["clock"]["offset"], offset,
                3 * run["clock"]["offset_uncertainty"].get<double>());
    EXPECT_LT(run["clock"]["offset_uncertainty"], 0.1);
    EXPECT_NEAR(run["dynamic_friction"], made["dynamic"], 4 * noise / std::sqrt(300.0) + 1e-4);
    EXPECT_NEAR(run["static_friction"], made["static"], 0.0019 + 3 * noise);  // a sample's step
    EXPECT_TRUE(run["static_is_distinct"]);
    EXPECT_NEAR(run["sliding_speed"], 1.3e-3, 5e-6);
    const auto& slip = run["stick_slip"];
    EXPECT_NEAR(slip["period"], 2.4e-3, 0.03e-3);
    EXPECT_NEAR(slip["amplitude"], 0.012, slip["amplitude_resolution"].get<double>() + 2 * noise);
  }
  EXPECT_NEAR(summary["dynamic_friction"]["mean"], 0.55 / 3, 3e-4);
  EXPECT_NEAR(summary["dynamic_friction"]["deviation"], 0.0040415, 4e-4);  // of 0.184 0.179 0.187
}

TEST_F(LabRecords, TheProgramLeavesCurvesFiguresSettingsAndAPage) {
  write("p.csv", press);
  write("l.csv", logger);
  const std::string arguments =
      "reduce l.csv p.csv --set 'compact.length=10 mm' --set compact.powder=316L -o done";
  ASSERT_EQ(pulvis(arguments), 0) << text_of(place / "err");
  EXPECT_THAT(text_of(place / "out"), HasSubstr("run-1: static 0.2"));
  for (const char* name : {"reduced-run-1.csv", "curves.csv", "summary.json", "reduce.toml"})
    EXPECT_TRUE(fs::exists(place / "done" / name)) << name;
  const std::string page = text_of(place / "done/report.html");
  EXPECT_THAT(
      page, AllOf(HasSubstr("drawChart("), HasSubstr("id=\"record-0\""), Not(HasSubstr("<!--@"))));
  EXPECT_EQ(pulvis(arguments), 2);  // results are there already
  EXPECT_EQ(pulvis(arguments + " --overwrite"), 0);
  EXPECT_EQ(pulvis("reduce done/reduce.toml p.csv l.csv -o again"),
            0);  // settings as they were used
  EXPECT_EQ(text_of(place / "again/reduced-run-1.csv"), text_of(place / "done/reduced-run-1.csv"));
}

TEST_F(LabRecords, TheProgramRefusesWithCodeTwo) {
  write("p.csv", press);
  write("l.csv", logger);
  const std::string compact = " --set 'compact.length=10 mm' --set compact.powder=316L";
  EXPECT_EQ(pulvis("reduce p.csv l.csv"), 2);
  EXPECT_THAT(text_of(place / "err"), HasSubstr("compact.length: none is given, allowed: "));
  EXPECT_EQ(pulvis("reduce p.csv p.csv" + compact), 2);
  EXPECT_THAT(text_of(place / "err"), HasSubstr("2 of the press and 0 of the logger are given"));
  EXPECT_EQ(pulvis("reduce" + compact), 2);
  EXPECT_EQ(pulvis("reduce p.csv l.csv --set compact.lenght=1 " + compact), 2);
  EXPECT_THAT(text_of(place / "err"), HasSubstr("did you mean 'length'?"));
  EXPECT_EQ(pulvis("reduce p.csv l.csv --simulation ." + compact), 2);
  EXPECT_THAT(text_of(place / "err"), HasSubstr("there is no such file"));
  EXPECT_FALSE(fs::exists(place / "reduced"));
}

TEST_F(LabRecords, ASimulationIsLaidOverThem) {
  fs::create_directories(place / "sim");
  std::ofstream(place / "sim/history.csv")
      << "time [s],tool/target/position_x [m],tool/target/force_x [N],tool/target/force_y [N]\n"
         "0,0.01,0,-100\n1,0.01,0,-100\n2,0.009,20,-100\n3,0.008,18,-90\n";
  const SimulatedCurve curve = read_simulation(place / "sim/", "target");
  EXPECT_EQ(curve.name, "sim");
  ASSERT_EQ(curve.distance.size(), 2u);
  EXPECT_NEAR(curve.distance[1], 2e-3, 1e-15);
  EXPECT_NEAR(curve.friction[1], 0.2, 1e-15);
  EXPECT_THAT(message_of([&] { read_simulation(place / "sim", "punch"); }),
              HasSubstr("the run has no tool 'punch', allowed: target"));
}

// ---- what is refused, with file and line

TEST_F(LabRecords, RefusesAGap) {
  auto lines = lines_of(logger);
  lines.erase(lines.begin() + 100, lines.begin() + 130);  // lines 101 to 130 of the file
  logger = joined(lines);
  EXPECT_THAT(
      logger_refusal(),
      StartsWith("logger.csv:101:1: time: a gap of 3.1 s after line 100, allowed: at most 0.5 s"));
}

TEST_F(LabRecords, RefusesTimeThatGoesBackOrStandsStill) {
  auto lines = lines_of(press);
  std::swap(lines[200], lines[201]);
  press = joined(lines);
  EXPECT_THAT(press_refusal(), AllOf(StartsWith("press.csv:202:1: Time: "),
                                     HasSubstr("does not come after"), HasSubstr("allowed: ")));
  lines = lines_of(logger);
  lines[50] = lines[49];
  logger = joined(lines);
  EXPECT_THAT(logger_refusal(), StartsWith("logger.csv:51:1: time: "));
}

TEST_F(LabRecords, RefusesMissingColumns) {
  replace_first(press, "Force", "Load");
  EXPECT_THAT(press_refusal(),
              StartsWith("press.csv:2:1: force: there is no such column, allowed: one of the "
                         "columns of the file: 'Time', 'Load', 'Displacement'"));
  EXPECT_EQ(press_refusal({"press.force=Load"}), "");
}

TEST_F(LabRecords, RefusesWrongUnits) {
  replace_first(press, "s;N;mm", "s;mm;N");
  EXPECT_THAT(press_refusal(), HasSubstr("press.csv:2:1: Force: "));
  replace_first(logger, "[um/m]", "[mV]");
  EXPECT_THAT(logger_refusal(),
              StartsWith("logger.csv:2:1: strain: has the unit 'mV', allowed: um/m, "));
}

TEST_F(LabRecords, RefusesASaturatedChannel) {
  EXPECT_THAT(
      press_refusal({"press.capacity=0.9 kN"}),
      AllOf(StartsWith("press.csv:"), HasSubstr(": Force: 90"), HasSubstr(" is saturated, ")));
  EXPECT_THAT(logger_refusal({"logger.strain_limit=2e-4"}), HasSubstr("logger.strain_limit"));
  EXPECT_THAT(logger_refusal({"logger.lvdt_limit=100 mV"}), HasSubstr("logger.lvdt_limit"));
}

TEST_F(LabRecords, RefusesAChannelThatRepeatsItsLargestValue) {
  auto lines = lines_of(logger);
  for (std::string& line : lines) {  // an amplifier that gives no more than 120 mV
    const std::size_t comma = line.rfind(',');
    if (std::isdigit(static_cast<unsigned char>(line[0])) != 0 &&
        std::stod(line.substr(comma + 1)) > 120)
      line = line.substr(0, comma) + ",120.0000";
  }
  logger = joined(lines);
  EXPECT_THAT(logger_refusal(), HasSubstr("lvdt: is saturated: it repeats its largest value, 10 "
                                          "times up to this line, allowed: "));
}

TEST_F(LabRecords, RefusesAPressThatWasNeverLoaded) {
  auto lines = lines_of(press);
  for (std::size_t i = 3; i < lines.size(); ++i)
    lines[i] = lines[i].substr(0, lines[i].find(';')) + ";0;0";
  press = joined(lines);
  EXPECT_THAT(press_refusal(), HasSubstr("Force: is zero throughout, allowed: a loaded press"));
}

TEST_F(LabRecords, RefusesARecordThatEndsAtOnce) {
  auto lines = lines_of(press);
  lines.resize(12);
  press = joined(lines);
  EXPECT_THAT(press_refusal(), HasSubstr("the record ends after 9 samples, allowed: at least 30"));
}

TEST_F(LabRecords, TurnsAPressThatCountsTheOtherWay) {
  const Settings settings = settings_of();
  const PressRecord plain = read_press(write("press.csv", press), settings);
  auto lines = lines_of(press);
  for (std::size_t i = 3; i < lines.size(); ++i) {
    std::string& line = lines[i];
    const std::size_t first = line.find(';'), second = line.rfind(';');
    const auto turned = [](const std::string& number) {
      return number[0] == '-' ? number.substr(1) : "-" + number;
    };
    line = line.substr(0, first + 1) + turned(line.substr(first + 1, second - first - 1)) + ";" +
           turned(line.substr(second + 1));
  }
  const PressRecord other = read_press(write("other.csv", joined(lines)), settings);
  EXPECT_EQ(plain.force, other.force);
  EXPECT_EQ(plain.displacement, other.displacement);
}

// ---- settings

TEST_F(LabRecords, SettingsAreCheckedLikeAScene) {
  const auto refusal = [](const std::string& text) {
    return message_of([&] { load_settings_text(text, "reduce.toml", {}); });
  };
  const std::string good = "[compact]\nlength = \"10 mm\"\npowder = \"316L\"\n";
  EXPECT_EQ(refusal(good), "");
  EXPECT_THAT(refusal(good + "[lvdt]\nsensitivity = \"3.58 mV\"\n"),
              StartsWith("reduce.toml:5:15: lvdt.sensitivity: "));
  EXPECT_THAT(refusal(good + "[load_cel]\ngain = 1\n"), HasSubstr("did you mean 'load_cell'?"));
  EXPECT_THAT(refusal(good + "poissons_ratio = 0.3\n"), HasSubstr("two are given, allowed: "));
  EXPECT_THAT(refusal(good + "[[run]]\npress = \"p.csv\"\n"),
              HasSubstr("run[0].logger: required key is missing"));
  EXPECT_THAT(refusal(good + "[analysis]\ndynamic_until = \"5 mm\"\n"),
              StartsWith("reduce.toml:5:17: analysis.dynamic_until: "));
  EXPECT_THAT(refusal(good + "[load_cell]\ngain = \"0 N\"\n"), HasSubstr("load_cell.gain: is 0 N"));
}

TEST_F(LabRecords, TheReferenceOfTheSettingsIsCurrent) {
  const fs::path docs = fs::path(paths::source_dir()) / "docs";
  EXPECT_EQ(text_of(docs / "reduce.md"), reference());
  EXPECT_EQ(text_of(docs / "reduce.schema.json"), json_schema());
}

}  // namespace
}  // namespace pulvis::lab
