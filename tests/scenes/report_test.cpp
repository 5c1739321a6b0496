// The report: one file that needs no other, for runs with and without tools.
#include "cli/report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>
#include <string>

#include "engine/output_error.hpp"
#include "tests/scenes/synthetic_run.hpp"

namespace pulvis {
namespace {

namespace fs = std::filesystem;
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

  std::string report() const {
    std::ostringstream text;
    text << std::ifstream(folder / "report.html").rdbuf();
    return text.str();
  }

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
  EXPECT_EQ(head["fields"].size(), 6U);  // two of one component, one of four; none of the nodes
  EXPECT_EQ(count_of(page, "<script type=\"application/octet-stream\""),
            2 + head["frames"].size() * (1 + head["fields"].size()));
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

TEST_F(ReportTest, ShowsLocalDensitiesAndContactsOfTheLastFrame) {
  testing::SyntheticRun run;
  run.observed = true;
  const auto head = head_of(report_of(run));
  EXPECT_EQ(head["density"]["cells"].size(), 4U);
  EXPECT_TRUE(head["density"]["cells"][1].is_null());  // a tool fills it
  EXPECT_NEAR(head["density"]["y"].back().get<double>(), 0.97 * 0.8e-3 * 4 + 0.03 * 4e-3, 1e-4);
  EXPECT_EQ(head["network"]["number"].size(), 18U);
  EXPECT_THAT(report(), HasSubstr("id=\"network\""));
  EXPECT_FALSE(head_of(report_of({})).contains("network"));
  const std::string script = std::string("/usr/bin/python3 '") + PULVIS_SOURCE_DIR +
                             "/cli/figures.py' '" + folder.string() + "' >/dev/null";
  testing::record(run, folder);
  write_report(folder);
  EXPECT_EQ(std::system(script.c_str()), 0);
  for (const char* name : {"local_density", "density_profile", "contact_network", "contact_rose"})
    EXPECT_TRUE(fs::exists(folder / "pictures" / (std::string(name) + ".png"))) << name;
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

// The pictures for papers come from the same folder, by a script.
TEST_F(ReportTest, HasPicturesDrawnByTheScript) {
  testing::record({}, folder);
  const std::string script = std::string("/usr/bin/python3 '") + PULVIS_SOURCE_DIR +
                             "/cli/figures.py' '" + folder.string() + "'";
  EXPECT_EQ(std::system((script + " >/dev/null").c_str()), 0);
  for (const std::string name : {"effective_stress", "force", "stress_ratio", "energies"}) {
    EXPECT_TRUE(fs::exists(folder / "pictures" / (name + ".png"))) << name;
  }
  EXPECT_EQ(std::system((script + " --field stress:2 --frame 1 >/dev/null").c_str()), 0);
  EXPECT_TRUE(fs::exists(folder / "pictures" / "stress_2.png"));
  EXPECT_NE(std::system((script + " --field none >/dev/null 2>&1").c_str()), 0);
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
