// The report: one file that needs no other, for runs with and without tools.
#include "cli/report/report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "engine/files/output_error.hpp"
#include "tests/helpers/paths.hpp"
#include "tests/helpers/synthetic_run.hpp"

namespace pulvis {
namespace {

namespace fs = std::filesystem;
using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

class ReportTest : public ::testing::Test {
 protected:
  // Kept where the environment names a place: tests/report_in_browser.sh opens what lies there.
  void SetUp() override {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    const char* const kept = std::getenv("PULVIS_KEEP_REPORTS");
    keep = kept != nullptr;
    folder = (keep ? fs::path(kept) : fs::temp_directory_path()) /
             (keep ? test->name() : "pulvis-report-" + std::to_string(getpid()) + test->name());
    fs::remove_all(folder);
  }
  void TearDown() override {
    if (!keep) fs::remove_all(folder);
  }

  std::string report_of(const testing::SyntheticRun& run) const {
    testing::record(run, folder);
    write_report(folder);
    return report();
  }

  static std::string text_of(const fs::path& file) {
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
  }
  std::string report() const { return text_of(folder / "report.html"); }

  fs::path folder;
  bool keep = false;
};

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

nlohmann::json head_of(const std::string& page) {
  const std::string opening = "<script type=\"application/json\" id=\"head\">";
  const auto begin = page.find(opening) + opening.size();
  return nlohmann::json::parse(page.substr(begin, page.find("</script>", begin) - begin));
}

// Everything a browser would fetch is named in one of these ways.
TEST_F(ReportTest, LoadsNothingFromElsewhere) {
  const std::string page = report_of({});
  for (const char* way : {" src=", "<link", "@import", "fetch(", "XMLHttpRequest", "WebSocket",
                          "url(http", "<iframe", "sendBeacon"}) {
    EXPECT_THAT(page, Not(HasSubstr(way)));
  }
  EXPECT_FALSE(std::regex_search(page.substr(0, page.find("id=\"head\"")),
                                 std::regex("(href|import)[^;]{0,9}https?:")));
  EXPECT_THAT(page, HasSubstr("default-src 'none'"));
  EXPECT_THAT(page, Not(HasSubstr("twgl.js 7")));  // the library is for three dimensions alone
}

TEST_F(ReportTest, HoldsTheMeshTheHistoryAndEveryFrame) {
  const testing::SyntheticRun run;
  const std::string page = report_of(run);
  const auto head = head_of(page);
  EXPECT_EQ(head["frames"].size(), static_cast<std::size_t>(run.frames));
  EXPECT_EQ(head["mesh"]["cells"], run.rows * run.columns * run.divisions * run.divisions);
  EXPECT_EQ(head["mesh"]["particles"], 16);
  EXPECT_EQ(head["samples"], (run.frames - 1) * run.samples_a_frame + 1);
  EXPECT_EQ(head["series"][0]["name"], "time");
  EXPECT_EQ(head["fields"].size(), 7U);  // two of one component, one of four, the speed
  EXPECT_EQ(count_of(page, "<script type=\"application/octet-stream\""),
            5 + head["frames"].size() * (2 + head["fields"].size()));
}

TEST_F(ReportTest, KeepsTextOfTheRunFromBecomingMarkup) {
  const std::string page = report_of({});
  EXPECT_THAT(page, HasSubstr("A synthetic compact &lt;/script&gt;&lt;b&gt;&amp; more&lt;/b&gt;"));
  EXPECT_THAT(page, Not(HasSubstr("<b>& more")));
  EXPECT_EQ(head_of(page)["title"], "A synthetic compact </script><b>& more</b>");
}

TEST_F(ReportTest, WorksWithoutToolsAndWithoutASummary) {
  testing::SyntheticRun run;
  run.tools = false;
  testing::record(run, folder);
  fs::remove(folder / "summary.json");
  write_report(folder);
  EXPECT_EQ(head_of(report())["title"], "A synthetic compact");
}

TEST_F(ReportTest, OutlivesABrokenSummary) {
  testing::record({}, folder);
  std::ofstream(folder / "summary.json") << "{\"steps\": ";
  write_report(folder);
  EXPECT_EQ(head_of(report())["summary"]["version"], "0.1.0");
}

TEST_F(ReportTest, ShowsTheLastFrameOfARunOfOneFrame) {
  testing::SyntheticRun run;
  run.frames = 1;
  EXPECT_EQ(head_of(report_of(run))["frames"].size(), 1U);
}

TEST_F(ReportTest, ShowsLocalDensitiesAndContactsOfEveryFrame) {
  testing::SyntheticRun run;
  run.observed = true;
  const auto head = head_of(report_of(run));
  const auto& last = head["frames"].back();
  EXPECT_EQ(last["density"]["cells"].size(), 4U);
  EXPECT_TRUE(last["density"]["cells"][1].is_null());  // a tool fills it
  EXPECT_NEAR(last["density"]["y"].back().get<double>(), 0.97 * 0.8e-3 * 4 + 0.03 * 4e-3, 1e-4);
  EXPECT_EQ(last["network"]["number"].size(), 18U);
  EXPECT_EQ(last["network"]["lines"], 13);  // twelve pairs, one at the bottom
  EXPECT_THAT(report(), HasSubstr("id=\"frame-5-network\""));
  EXPECT_FALSE(head_of(report_of({}))["frames"].back().contains("network"));
  const std::string command =
      std::string("'") + paths::program() + "' figure '" + folder.string() + "' >/dev/null";
  testing::record(run, folder);
  write_report(folder);
  EXPECT_EQ(std::system(command.c_str()), 0);
  for (const char* name : {"local_density", "density_profile", "contact_network", "contact_rose"})
    EXPECT_TRUE(fs::exists(folder / "pictures" / (std::string(name) + ".png"))) << name;
}

TEST_F(ReportTest, ShowsThePeriodicCellWithTheParticlesInside) {
  const auto plain = head_of(report_of({}));
  EXPECT_FALSE(plain["frames"].back().contains("cell"));
  EXPECT_DOUBLE_EQ(plain["low"][0].get<double>(), 0);
  testing::SyntheticRun run;
  run.tools = false;
  run.cell = run.observed = true;
  const auto head = head_of(report_of(run));
  const auto near = [](double value) { return DoubleNear(value, 1e-15); };
  EXPECT_THAT(head["frames"].back()["cell"].get<std::vector<double>>(),
              ElementsAre(near(1e-3), 0, near(4e-3), 0, 0, near(0.97 * 3.2e-3 + 0.03 * 4e-3)));
  EXPECT_NEAR(head["low"][0].get<double>(), 1e-3, 1e-15);  // the first column is drawn as the last
  EXPECT_NEAR(head["high"][0].get<double>(), 5e-3, 1e-15);
  const std::string command =
      std::string("'") + paths::program() + "' figure '" + folder.string() + "' >/dev/null";
  EXPECT_EQ(std::system(command.c_str()), 0);
  for (const char* name : {"effective_stress", "contact_network"})
    EXPECT_TRUE(fs::exists(folder / "pictures" / (std::string(name) + ".png"))) << name;
}

TEST_F(ReportTest, ShowsBondsCracksAndFragmentsOfEveryFrame) {
  const auto plain = head_of(report_of({}));
  for (const char* part : {"bonds", "cracks", "fragments"})
    EXPECT_FALSE(plain["frames"].back().contains(part)) << part;
  testing::SyntheticRun run;
  run.bonds = true;
  const auto head = head_of(report_of(run));
  EXPECT_EQ(head["frames"][0]["bonds"], 3);
  EXPECT_EQ(head["frames"][0]["cracks"], 0);
  EXPECT_EQ(head["frames"][0]["fragments"]["count"], 1);
  const auto& last = head["frames"].back();
  EXPECT_EQ(last["cracks"], 3);  // four columns, apart
  EXPECT_EQ(last["fragments"]["count"], 4);
  EXPECT_EQ(last["fragments"]["number"].back(), 1);
  EXPECT_EQ(last["fragments"]["area"].back(), 1);
  EXPECT_NEAR(last["fragments"]["diameter"].back(), std::sqrt(4 * 4e-6 / std::numbers::pi), 1e-8);
  for (const char* part : {"id=\"frame-0-bonds\"", "id=\"frame-5-cracks\"", "Bonds: energy"})
    EXPECT_THAT(report(), HasSubstr(part));
  std::vector<std::string> names;
  for (const auto& field : head["fields"]) names.push_back(field["name"]);
  EXPECT_THAT(names, ::testing::IsSupersetOf({"damage", "fragment"}));
}

TEST_F(ReportTest, DrawsBondsCracksAndFragments) {
  testing::SyntheticRun run;
  run.bonds = true;
  testing::record(run, folder);
  const auto figure = [&](const std::string& options) {
    return std::system((std::string("'") + paths::program() + "' figure '" + folder.string() +
                        "' " + options + " >/dev/null")
                           .c_str());
  };
  EXPECT_EQ(figure(""), 0);
  for (const char* name : {"cracks", "breaking", "fragment_sizes"})
    EXPECT_TRUE(fs::exists(folder / "pictures" / (std::string(name) + ".png"))) << name;
  for (const std::string field : {"damage", "fragment"})
    EXPECT_EQ(figure("--field " + field + " -o " + (folder / (field + ".svg")).string()), 0);
  EXPECT_EQ(figure("--format csv --frame 3 -o " + (folder / "numbers").string()), 0);
  std::istringstream rows(text_of(folder / "numbers" / "cracks.csv"));
  std::string row;
  std::getline(rows, row);
  EXPECT_EQ(row, "x1 [m],y1 [m],x2 [m],y2 [m],time [SI],length [SI],shear [SI],energy [SI]\r");
  std::size_t count = 0;
  while (std::getline(rows, row)) ++count;
  EXPECT_EQ(count, 2U);  // of frame 3
}

TEST_F(ReportTest, ShowsTheCurvesOfARunWithoutFrames) {
  testing::SyntheticRun run;
  run.pictures = false;
  const auto head = head_of(report_of(run));
  EXPECT_EQ(head["frames"].size(), 0U);
  EXPECT_EQ(head["samples"], (run.frames - 1) * run.samples_a_frame + 1);
}

TEST_F(ReportTest, LaysSeveralRunsSideBySide) {
  testing::SyntheticRun wide;
  wide.columns = 6;
  testing::record({}, folder / "one");
  testing::record(wide, folder / "other");
  write_comparison({folder / "one", folder / "other"}, folder / "report.html");
  const auto runs = head_of(report())["runs"];
  ASSERT_EQ(runs.size(), 2U);
  EXPECT_EQ(runs[0]["mesh"]["particles"], 16);
  EXPECT_EQ(runs[1]["mesh"]["particles"], 24);
  EXPECT_EQ(runs[1]["folder"], "other");
  EXPECT_THAT(report(), HasSubstr("id=\"run-1-frame-5-position\""));
}

// A hundred particles of the usual size: the file can still be mailed.
TEST_F(ReportTest, StaysSmall) {
  testing::SyntheticRun run;
  run.columns = run.rows = 10;
  run.frames = 51;
  const std::string page = report_of(run);
  const auto head = head_of(page);
  EXPECT_LT(page.size(), 15'000'000U);
  EXPECT_GE(head["frames"].size(), 20U);
  EXPECT_EQ(head["frames"].back()["step"], 94 * 50 * run.samples_a_frame);
}

// The figures for papers come from the same folder, drawn by scripts that the program carries.
TEST_F(ReportTest, HasFiguresForPapers) {
  testing::record({}, folder);
  const auto figure = [&](const std::string& options) {
    const std::string program =
        std::string("'") + paths::program() + "' figure '" + folder.string();
    return std::system((program + "' " + options + " >/dev/null 2>&1").c_str());
  };
  EXPECT_EQ(figure(""), 0);
  for (const std::string name : {"effective_stress", "force", "stress_ratio", "energies"}) {
    EXPECT_TRUE(fs::exists(folder / "pictures" / (name + ".png"))) << name;
  }
  EXPECT_EQ(figure("--field stress:2 --frame 1"), 0);
  EXPECT_TRUE(fs::exists(folder / "pictures" / "stress_2.png"));
  EXPECT_EQ(figure("--field stress:2 --frame 1 -o " + (folder / "one.svg").string()), 0);
  EXPECT_THAT(text_of(folder / "one.svg"), HasSubstr("<svg"));
  EXPECT_NE(figure("--field none"), 0);
  EXPECT_NE(figure("--series none"), 0);
}

// What is plotted can be had as numbers: those of the history.
TEST_F(ReportTest, WritesPlottedSeriesAsNumbers) {
  testing::record({}, folder);
  const std::string table = (folder / "f.csv").string();
  const std::string command = std::string("'") + paths::program() + "' figure '" + folder.string() +
                              "' --series tool/top/force_y --against relative_density -o " + table;
  ASSERT_EQ(std::system((command + " >/dev/null").c_str()), 0);
  std::istringstream rows(text_of(table)), history(text_of(folder / "history.csv"));
  std::string row, of_history;
  std::getline(rows, row);
  std::getline(history, of_history);
  EXPECT_EQ(row, "relative_density [-],tool/top/force_y [N]\r");
  const auto column = [&](const std::string& name) {  // of the history
    const auto before = of_history.substr(0, of_history.find(name));
    return static_cast<std::size_t>(std::count(before.begin(), before.end(), ','));
  };
  const std::size_t density = column("relative_density"), force = column("tool/top/force_y");
  std::size_t count = 0;
  while (std::getline(rows, row) && std::getline(history, of_history)) {
    std::vector<std::string> cells(1);
    for (const char c : of_history) {
      if (c == ',')
        cells.emplace_back();
      else
        cells.back() += c;
    }
    double first = 0, second = 0;
    ASSERT_EQ(std::sscanf(row.c_str(), "%lf,%lf", &first, &second), 2);
    EXPECT_DOUBLE_EQ(first, std::stod(cells.at(density)));
    EXPECT_DOUBLE_EQ(second, std::stod(cells.at(force)));
    ++count;
  }
  EXPECT_EQ(count, 101U);
}

TEST_F(ReportTest, SaysWhichFolderHoldsNoRun) {
  try {
    write_report(folder);
    FAIL() << "was not refused";
  } catch (const OutputError& error) {
    EXPECT_EQ(error.path(), folder / "run.h5");
  }
}

}  // namespace
}  // namespace pulvis
