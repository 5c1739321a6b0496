// What a study says over its runs: mean and standard deviation over seeds, main effects, values at peak density, quality
// flags and thumbnails.
#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/report/report_thumbnail.hpp"
#include "engine/files/hdf5.hpp"
#include "tests/helpers/program.hpp"

namespace pulvis {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using ::testing::HasSubstr;

double value_of(const Json& values, const std::string& name, const char* part) {
  for (const Json& one : values)
    if (one["name"] == name) return one[part].get<double>();
  ADD_FAILURE() << "no " << name;
  return std::nan("");
}

struct Numbers {
  std::vector<double> all;

  double mean() const {
    double sum = 0;
    for (const double v : all) sum += v;
    return sum / static_cast<double>(all.size());
  }
  double deviation() const {
    double squares = 0;
    for (const double v : all) squares += (v - mean()) * (v - mean());
    return std::sqrt(squares / static_cast<double>(all.size() - 1));
  }
};

class StudyStatisticsTest : public ProgramTest {
 protected:
  void run_study() {
    results = place / "results";
    std::ofstream(place / "study.toml")
        << "scene = \"" << scene("compaction/regular-25.toml") << R"("
seeds = [1, 2, 3]
[set]
"stage.press.duration" = "20 us"
"stage.press.move[0].displacement" = ["0 mm", "-0.9 mm"]
"packing[0].perturbation" = 0.02
"packing[0].spacing" = "9.9 mm"
"packing[0].corner" = ["0.3 mm", "0.3 mm"]
particle.disc.diameter = "9.4 mm"
output.frames = 2
output.samples = 40
limits.penetration = 1
[grid]
contact.friction = [0.1, 0.4]
)";
    const Outcome end =
        pulvis({"study", (place / "study.toml").string(), "-o", results.string(), "--jobs", "2"});
    ASSERT_EQ(end.code, 0) << end.out << end.err;
    json = Json::parse(text_of(results / "summary.json"));
  }

  Numbers of_variation(const std::string& variation, const std::string& name) const {
    Numbers numbers;
    for (const Json& run : json["runs"])
      if (variation.empty() || run["variation"] == variation)
        numbers.all.push_back(value_of(run["values"], name, "value"));
    return numbers;
  }

  fs::path results;
  Json json;
};

TEST_F(StudyStatisticsTest, AreThoseOfTheRuns) {
  ASSERT_NO_FATAL_FAILURE(run_study());
  const std::string name = "top_force_max";
  ASSERT_EQ(json["variations"].size(), 2U);
  for (const Json& variation : json["variations"]) {
    const Numbers seeds = of_variation(variation["variation"].get<std::string>(), name);
    ASSERT_EQ(seeds.all.size(), 3U);
    EXPECT_GT(seeds.deviation(), 0);  // the packings differ
    EXPECT_NEAR(value_of(variation["values"], name, "mean"), seeds.mean(), 1e-9 * seeds.mean());
    EXPECT_NEAR(value_of(variation["values"], name, "standard_deviation"), seeds.deviation(),
                1e-9 * seeds.mean());
  }
  const Json& effect = json["effects"][0];
  EXPECT_EQ(effect["key"], "contact.friction");
  EXPECT_TRUE(effect["balanced"]);
  ASSERT_EQ(effect["levels"].size(), 2U);
  EXPECT_EQ(effect["levels"][1]["level"], "0.4");
  EXPECT_NEAR(value_of(effect["levels"][1]["values"], name, "mean"),
              of_variation("friction=0.4", name).mean(), 1e-9);
  EXPECT_THAT(text_of(results / "variations.csv"),
              HasSubstr("top_force_max mean [N],top_force_max standard deviation [N]"));
  EXPECT_THAT(text_of(results / "effects.csv"),
              HasSubstr("contact.friction,0.4,top_force_max,N,3,"));

  // The curve's mean and deviation at its last place, of three curves that are there.
  const Json curves = Json::parse(text_of(results / "curves.json"));
  const Json& line = curves[0]["lines"][0];
  ASSERT_EQ(line["standard_deviation"].size(), line["y"].size());
  for (std::size_t i = 0; i < line["y"].size(); ++i) {
    const double low = line["low"][i], high = line["high"][i], s = line["standard_deviation"][i];
    EXPECT_GE(s, (high - low) / 2 - 1e-12);  // of three, from half the range to 1/sqrt(3) of it
    EXPECT_LE(s, (high - low) / std::sqrt(3.0) + 1e-12);
  }
}

TEST_F(StudyStatisticsTest, PeakIsTheDensestSample) {
  ASSERT_NO_FATAL_FAILURE(run_study());
  const Json& run = json["runs"][0];
  const auto file = hdf5::File::open(results / run["name"].get<std::string>() / "run.h5");
  const auto density = file.read_doubles("/history/relative_density");
  const auto force = file.read_doubles("/history/tool/top/force_y");
  const auto at = static_cast<std::size_t>(std::ranges::max_element(density) - density.begin());
  EXPECT_EQ(value_of(run["values"], "peak/relative_density", "value"), density[at]);
  EXPECT_EQ(value_of(run["values"], "peak/top_force", "value"), force[at]);
  EXPECT_THAT(text_of(results / "study.csv"), HasSubstr(",peak/transmission [-],"));
}

// Pressed within 20 us the discs bend their elements too much: the value beyond its limit is named.
TEST_F(StudyStatisticsTest, ABadRunIsFlaggedWithWhy) {
  ASSERT_NO_FATAL_FAILURE(run_study());
  for (const Json& run : json["runs"]) {
    ASSERT_FALSE(run["quality"].empty());
    EXPECT_THAT(run["quality"].dump(), HasSubstr("hourglass energy "));
    EXPECT_THAT(run["quality"].dump(), HasSubstr("% (limit 3%)"));
  }
  EXPECT_THAT(text_of(results / "study.csv"), HasSubstr("hourglass energy "));
}

TEST_F(StudyStatisticsTest, EveryRunHasAThumbnailInThePageAlone) {
  ASSERT_NO_FATAL_FAILURE(run_study());
  const std::string page = text_of(results / "report.html"), start = "data:image/png;base64,iVBOR";
  int count = 0;
  for (std::size_t at = page.find(start); at != std::string::npos; at = page.find(start, at + 1))
    ++count;
  EXPECT_EQ(count, 6);
  EXPECT_FALSE(json["runs"][0].contains("thumbnail"));
}

TEST(Thumbnail, AllOfAStudyFitIntoItsPixels) {
  for (const std::size_t count : {1U, 10U, 100U, 1000U, 1300U}) {
    const auto side = static_cast<std::size_t>(thumbnail_side(count, 3'000'000));
    EXPECT_GE(side, 48U);
    EXPECT_LE(count * side * side, 3'000'000U);
  }
  EXPECT_EQ(thumbnail_side(5, 3'000'000), 240);
  EXPECT_EQ(thumbnail_side(5000, 3'000'000), 0);
}

}  // namespace
}  // namespace pulvis
