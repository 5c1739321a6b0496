// Study files: what they are multiplied out to, and what is refused, at its line.
#include "cli/campaigns/study/study_read.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "cli/campaigns/study/analysis/study_fits.hpp"
#include "scenes/language/problem.hpp"
#include "tests/helpers/paths.hpp"
#include "tests/helpers/wrong.hpp"

namespace pulvis {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

const std::string shipped = paths::source_dir() + "/scenes/";
const std::string matrix = "scene = \"" + shipped + "compaction/regular-25.toml\"\n";

class StudyRead : public ::testing::Test {
 protected:
  void SetUp() override {
    file = fs::temp_directory_path() / ("pulvis-study-" + std::to_string(getpid()) + ".toml");
  }
  void TearDown() override { fs::remove(file); }

  Study read(const std::string& text, const std::vector<std::string>& overrides = {}) const {
    std::ofstream(file) << text;
    return load_study(file, overrides);
  }

  // The message without the file's name: "3:1: grid.x: ...".
  std::string refusal(const std::string& text) const {
    return without(file.string() + ":", message_of([&] { read(text); }));
  }

  fs::path file;
};

TEST_F(StudyRead, GridListAndSeedsAreMultipliedOut) {
  const Study study = read(matrix + R"(seeds = [3, 4]
[set]
output.frames = 7
[[variation]]
name = "a"
[[variation]]
name = "b"
set = { contact.damping = 0.2 }
[grid]
contact.friction = [0.1, 0.3]
"stage.press.duration" = ["1 ms", "2 ms"]
)");
  EXPECT_EQ(study.runs.size(), 16U);
  EXPECT_EQ(study.variations.size(), 8U);
  EXPECT_EQ(study.runs[0].name, "a,friction=0.1,duration=1ms,seed=3");
  EXPECT_EQ(study.runs[1].name, "a,friction=0.1,duration=1ms,seed=4");
  EXPECT_EQ(study.runs[2].name, "a,friction=0.1,duration=2ms,seed=3");
  const StudyRun& last = study.runs.back();
  EXPECT_EQ(last.variation, "b,friction=0.3,duration=2ms");
  EXPECT_EQ(last.scene.contact.friction, 0.3);
  EXPECT_EQ(last.scene.contact.damping, 0.2);
  EXPECT_EQ(last.scene.stages[0].duration, 2e-3);
  EXPECT_EQ(last.scene.output.frames, 7);
  EXPECT_EQ(last.scene.seed, 4U);
  EXPECT_EQ(study.runs.front().scene.contact.damping, 0.1);
}

// The study's own settings give way to all others.
TEST_F(StudyRead, TheNearestSettingWins) {
  const std::string text = matrix + R"([set]
contact.friction = 0.5
time.safety = 0.5
output.frames = 5
contact.damping = 0.5
[[variation]]
name = "a"
set = { output.frames = 4 }
[grid]
time.safety = [0.3]
)";
  const Scene scene = read(text, {"contact.friction=0.2"}).runs.front().scene;
  EXPECT_EQ(scene.contact.friction, 0.2);
  EXPECT_EQ(scene.time.safety, 0.3);
  EXPECT_EQ(scene.output.frames, 4);
  EXPECT_EQ(scene.contact.damping, 0.5);
}

// Otherwise names and tables would give values that the runs do not have.
TEST_F(StudyRead, ValuesThatAreVariedCannotBeReplaced) {
  const std::string text = matrix + "seeds = [1, 2]\n";
  const std::string grid = "[grid]\n\"material.316L.density\" = [\"7 g/cm^3\", \"8 g/cm^3\"]\n";
  const auto told = [&](const std::string& whole, const std::string& change) {
    const std::string wrong = message_of([&] { read(whole, {change}); });
    EXPECT_EQ(std::ranges::count(wrong, '\n'), 0) << wrong;
    return wrong;
  };
  const std::string replaces = ": replaces a value that the study varies";
  EXPECT_THAT(told(text + grid, "material[0].density=9 g/cm^3"),
              HasSubstr("--set material[0].density=9 g/cm^3: material[0].density" + replaces));
  EXPECT_THAT(told(text + grid, "seed=7"), HasSubstr("--set seed=7: seed" + replaces));
  EXPECT_THAT(refusal(text + "overrides = [\"seed=7\"]\n"), HasSubstr("3:13: seed" + replaces));
  EXPECT_THAT(refusal(text + "[grid]\nseed = [3, 4]\n"), HasSubstr("seed" + replaces));
  EXPECT_THAT(refusal(matrix + "[[variation]]\nname = \"a\"\nset = { contact.friction = 0.4 }\n"
                               "[grid]\ncontact.friction = [0.1]\n"),
              HasSubstr("6:21: contact.friction" + replaces));
  EXPECT_EQ(read(matrix + grid, {"seed=7", "contact.friction=0.2"}).runs.size(), 2U);
}

// What is the same scene has the same hash, whatever it is called: a run is known again by it.
TEST_F(StudyRead, AHashChangesWithTheSceneOnly) {
  const Study one = read(matrix + "[grid]\ncontact.friction = [0.1, 0.3]\n");
  const Study other = read(matrix + "title = \"x\"\n[grid]\ncontact.friction = [0.3, 0.2]\n");
  EXPECT_EQ(one.runs[1].hash, other.runs[0].hash);
  EXPECT_NE(one.runs[0].hash, other.runs[1].hash);
}

TEST_F(StudyRead, KeysThatEndAlikeAreNamedInFull) {
  const Study study = read(matrix +
                           "[grid]\n\"material.316L.density\" = [\"7990 kg/m^3\"]\n"
                           "\"tool.top.point\" = [[\"0 mm\", \"50 mm\"]]\n"
                           "\"tool.left.point\" = [[\"0 mm\", \"0 mm\"]]\n");
  EXPECT_THAT(study.variations, ElementsAre("density=7990kg-m-3,tool.top.point=0mm_50mm,"
                                            "tool.left.point=0mm_0mm"));
}

TEST_F(StudyRead, WithoutAnyVariationThereIsOneRun) {
  EXPECT_THAT(read(matrix).variations, ElementsAre("base"));
}

TEST_F(StudyRead, CurvesAreThoseOfACompactionWhereNoneIsGiven) {
  const Study study = read(matrix);
  ASSERT_EQ(study.spec.curves.size(), 3U);
  EXPECT_EQ(study.spec.curves[0].y, "stress_ratio/axial");
  EXPECT_EQ(study.spec.curves[1].x, "travel/top");
}

TEST_F(StudyRead, CurvesInSpaceAreThoseOfThePunchAlongZ) {
  const Study study =
      read("scene = \"" + paths::source_dir() + "/scenes/compaction-3d/unit-cell-sc.toml\"\n");
  ASSERT_EQ(study.spec.curves.size(), 3U);
  EXPECT_EQ(study.spec.curves[1].y, "tool/top/force_z");
  EXPECT_EQ(study.spec.curves[1].x, "travel/top");
  EXPECT_EQ(study.spec.curves[2].y, "stress/transmission");
}

TEST_F(StudyRead, BoundsAreConvertedToTheUnitOfTheSeries) {
  const Study study = read(matrix + R"([[expect]]
series = "pressure/top"
against = "travel/top"
at = "2 mm"
of = "base"
above = "10 MPa"
)");
  EXPECT_DOUBLE_EQ(study.spec.expects[0].at->number, 2e-3);
  EXPECT_DOUBLE_EQ(study.spec.expects[0].above->number, 1e7);
}

std::string with_fit(const std::string& lines, const std::string& seeds = "[1, 2, 3, 4, 5]") {
  return "seeds = " + seeds + "\n" + matrix + "[[fit]]\n" + lines;
}

TEST_F(StudyRead, LawsOfStrengthAreChecked) {
  const std::string weibull = "law = \"weibull\"\nseries = \"tool/top/force_y\"\n";
  const Study study = read(with_fit(weibull + "against = \"time\"\nfrom = \"1 ms\"\n"));
  EXPECT_DOUBLE_EQ(study.spec.fits[0].from->number, 1e-3);
  EXPECT_THAT(refusal(with_fit("law = \"weibull\"\nseries = \"force\"\n")),
              HasSubstr("5:10: fit[0].series: a run of 'base' has no series 'force'"));
  EXPECT_THAT(
      refusal(with_fit(weibull, "[1, 2, 3, 4]")),
      HasSubstr("fit[0].law: 4 runs of 'base' can be fitted, allowed: at least 5 (`seeds`)"));
  EXPECT_THAT(refusal(with_fit(weibull + "disc = \"ball\"\n")),
              HasSubstr("6:8: fit[0].disc: 'ball' is not a class of discs"));
  EXPECT_THAT(refusal(with_fit(weibull + "disc = \"disc\"\narea = \"1 mm^2\"\n")),
              HasSubstr("fit[0].disc: has no effect together with `area`"));
  EXPECT_THAT(refusal(with_fit("law = \"weibull\"\nseries = \"pressure/top\"\ndisc = \"disc\"\n")),
              HasSubstr("fit[0].series: 'pressure/top' is not a force"));
  EXPECT_THAT(refusal(with_fit(weibull + "at = 0.8\nwhen = \"max\"\n")),
              HasSubstr("fit[0].when: has no effect together with `at`"));
  EXPECT_THAT(refusal(with_fit(weibull + "density = \"relative_density\"\n")),
              HasSubstr("fit[0].density:"));
  const std::string porous = "law = \"ryshkewitch_duckworth\"\nseries = \"pressure/top\"\n";
  EXPECT_THAT(refusal(with_fit(porous + "density = \"time\"\n")),
              HasSubstr("6:11: fit[0].density: 'time' is not a relative density"));
  EXPECT_THAT(refusal(with_fit(porous + "density = \"denstiy\"\n")),
              HasSubstr("fit[0].density: a run of 'base' has no series 'denstiy'"));
  EXPECT_THAT(refusal(with_fit(porous + "by = [\"contact.friction\"]\n")),
              HasSubstr("6:6: fit[0].by: the study does not vary 'contact.friction'"));
  EXPECT_THAT(refusal(with_fit(porous, "[1, 2]")),
              HasSubstr("2 runs of 'all runs' can be fitted, allowed: at least 3"));
}

TEST_F(StudyRead, RunsAreFittedByVariationOrKey) {
  const Study study = read("seeds = [1, 2, 3, 4, 5]\n" + matrix + R"([[fit]]
law = "weibull"
series = "pressure/top"
[[fit]]
law = "ryshkewitch_duckworth"
series = "pressure/top"
by = ["contact.friction"]
[grid]
contact.friction = [0.1, 0.3]
"stage.press.duration" = ["1 ms", "2 ms"]
)");
  const auto weibull = groups_of(study, study.spec.fits[0]);
  ASSERT_EQ(weibull.size(), 4U);
  EXPECT_EQ(weibull[3].name, "friction=0.3,duration=2ms");
  EXPECT_EQ(weibull[3].runs.size(), 5U);
  const auto porous = groups_of(study, study.spec.fits[1]);
  ASSERT_EQ(porous.size(), 2U);
  EXPECT_EQ(porous[0].name, "contact.friction=0.1");
  EXPECT_EQ(porous[0].runs.size(), 10U);
}

TEST_F(StudyRead, EverythingShippedIsRight) {
  int studies = 0;
  for (const auto& entry : fs::directory_iterator(shipped + "studies")) {
    if (entry.path().extension() != ".toml") continue;
    const Study study = load_study(entry.path());
    EXPECT_FALSE(study.spec.expects.empty()) << entry.path();
    EXPECT_FALSE(study.spec.title.empty()) << entry.path();
    // One of the source's metals is made for both, shear for 316L alone (Sec. 6.2).
    bool steel = false, copper = false, shears = false;
    for (const StudyRun& run : study.runs) {
      steel = steel || run.scene.materials[0].name == "316L";
      copper = copper || run.scene.materials[0].name == "OFHC-Cu";
      for (const StageSpec& stage : run.scene.stages)
        shears = shears || stage.kind == StageSpec::Kind::shear;
    }
    const bool bonded = !study.runs.front().scene.bonds.empty();
    if (!bonded && (steel || copper)) {
      EXPECT_TRUE(steel && copper != shears) << entry.path();
    }
    ++studies;
  }
  EXPECT_GE(studies, 5);
}

TEST_F(StudyRead, WhatIsWrongIsToldAtItsLine) {
  EXPECT_THAT(refusal("title = \"x\"\n"), HasSubstr("scene: required key is missing"));
  EXPECT_THAT(refusal(""), HasSubstr("1:1: study: is empty"));
  EXPECT_THAT(refusal(matrix + "sceen = 1\n"),
              HasSubstr("2:1: sceen: unknown key, did you mean 'scene'?"));
  EXPECT_THAT(refusal("scene = \"none.toml\"\n"), HasSubstr("there is no such file"));
  EXPECT_THAT(refusal(matrix + "seeds = [1, 1]\n"), HasSubstr("2:9: seeds: a seed is given twice"));
  EXPECT_THAT(refusal(matrix + "seeds = []\n"), HasSubstr("2:9: seeds: an empty array"));
  EXPECT_THAT(refusal(matrix + "seeds = [-1]\n"), HasSubstr("out of range"));
  EXPECT_THAT(refusal(matrix + "grid = 3\n"), HasSubstr("2:1: grid: wrong type"));
  EXPECT_THAT(refusal(matrix + "[grid]\ncontact.friction = 0.1\n"),
              HasSubstr("3:20: grid.contact.friction: a number is given, allowed: one or more"));
  EXPECT_THAT(refusal(matrix + "[grid]\ncontact.friction = []\n"), HasSubstr("an empty array"));
  EXPECT_THAT(refusal(matrix + "[grid]\ncontact.friction = [0.1, 0.10]\n"),
              HasSubstr("two are called 'friction=0.1'"));
  EXPECT_THAT(refusal(matrix + "[[variation]]\nname = \"a\"\n[[variation]]\nname = \"a\"\n"),
              HasSubstr("'a' is the name of another variation"));
  EXPECT_THAT(refusal(matrix + "[[curve]]\ny = \"stress\"\n"),
              HasSubstr("3:5: curve[0].y: no run has the series 'stress'"));
}

// What a study does to a scene is refused where the study says it, once for all runs.
TEST_F(StudyRead, WrongKeysOfTheSceneAreToldInTheStudy) {
  const std::string wrong =
      refusal(matrix + "seeds = [1, 2, 3]\n[grid]\ncontact.frictoin = [0.1]\n");
  EXPECT_THAT(wrong, HasSubstr("4:21: contact.frictoin: unknown key, did you mean 'friction'?"));
  EXPECT_EQ(std::ranges::count(wrong, '\n'), 0) << wrong;
  EXPECT_THAT(refusal(matrix + "[set]\n\"stage.press.duration\" = \"3 kg\"\n"),
              HasSubstr("3:26: stage[0].duration:"));
}

std::string with_expect(const std::string& lines) {
  return matrix + "[grid]\ncontact.friction = [0.1, 0.3]\n[[expect]]\n" + lines;
}

TEST_F(StudyRead, ExpectationsThatSayNothingOrTooMuchAreRefused) {
  const std::string series = "series = \"tool/top/force_y\"\n";
  EXPECT_THAT(refusal(with_expect(series)), HasSubstr("none of `order`"));
  EXPECT_THAT(refusal(with_expect(series + "of = \"friction=0.1\"\nabove = 1\n"
                                           "ratio = [\"friction=0.1\", \"friction=0.3\"]\n")),
              HasSubstr("more than one of `order`"));
  EXPECT_THAT(refusal(with_expect(series + "of = \"friction=0.2\"\nabove = 1\n")),
              HasSubstr("6:6: expect[0].of: no variation is called 'friction=0.2', did you mean"));
  EXPECT_THAT(refusal(with_expect(series + "of = \"friction=0.1\"\n")),
              HasSubstr("no bound given"));
  EXPECT_THAT(refusal(with_expect(series + "of = \"friction=0.1\"\nequals = 1\n")),
              HasSubstr("expect[0].within: required"));
  EXPECT_THAT(refusal(with_expect(series + "of = \"friction=0.1\"\nabove = \"3 mm\"\n")),
              HasSubstr("7:9: expect[0].above:"));
  EXPECT_THAT(refusal(with_expect(series + "order = [\"friction=0.1\", \"friction=0.3\"]\n")),
              HasSubstr("expect[0].trend: required"));
  EXPECT_THAT(refusal(with_expect(series + "order = [\"friction=0.1\"]\ntrend = \"increasing\"\n")),
              HasSubstr("one variation is given"));
  EXPECT_THAT(refusal(with_expect(series + "effect = [\"friction=0.1\", \"friction=0.3\"]\n")),
              HasSubstr("expect[0].exceeds"));
  EXPECT_THAT(refusal(with_expect(series + "ratio = [\"friction=0.1\", \"friction=0.3\"]\n"
                                           "above = \"1 N\"\n")),
              HasSubstr("dimensionless"));
  EXPECT_THAT(refusal(with_expect(series + "of = \"friction=0.1\"\nat = 0.8\nwhen = \"max\"\n"
                                           "above = 1\n")),
              HasSubstr("no effect together with `at`"));
  EXPECT_THAT(refusal(with_expect("series = \"force\"\nof = \"friction=0.1\"\nabove = 1\n")),
              HasSubstr("5:10: expect[0].series: a run of 'friction=0.1' has no series 'force'"));
}

TEST_F(StudyRead, TheReferenceIsTheOneInTheDocs) {
  std::ostringstream text;
  text << std::ifstream(paths::source_dir() + "/docs/study.md").rdbuf();
  EXPECT_EQ(study_reference(), text.str()) << "pulvis study --reference text > docs/study.md";
}

}  // namespace
}  // namespace pulvis
