// Rough and measured target surfaces: what they are made of, how far they go, what is refused.
#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "scenes/tools/rough_profile.hpp"
#include "tests/helpers/experiment.hpp"
#include "tests/helpers/paths.hpp"
#include "tests/helpers/wrong.hpp"

namespace pulvis {
namespace {

using testing::HasSubstr;

// ---- rough --------------------------------------------------------------------------------------------
// Mean of h(x) h(x + lag) over the mean of h^2; the row repeats.
double autocorrelation(const std::vector<double>& heights, std::size_t lag) {
  double product = 0, square = 0;
  for (std::size_t i = 0; i < heights.size(); ++i) {
    product += heights[i] * heights[(i + lag) % heights.size()];
    square += heights[i] * heights[i];
  }
  return product / square;
}

TEST(RoughProfile, HasTheRoughnessThatIsAskedForExactly) {
  for (const std::uint64_t seed : {1U, 2U, 77U}) {
    const std::vector<double> heights = rough_heights(0.3e-6, seed, 64);
    std::vector<Vec2> chain;
    for (std::size_t i = 0; i <= heights.size(); ++i)
      chain.push_back({static_cast<double>(i), heights[i % heights.size()]});
    EXPECT_NEAR(arithmetic_roughness(chain), 0.3e-6, 1e-18);
    // By the midpoint rule, which knows nothing of zero crossings.
    double sum = 0;
    constexpr int stations = 100;
    for (std::size_t i = 0; i + 1 < chain.size(); ++i)
      for (int k = 0; k < stations; ++k)
        sum += std::abs(chain[i].y() + (chain[i + 1].y() - chain[i].y()) * (k + 0.5) / stations) /
               stations;
    EXPECT_NEAR(sum / static_cast<double>(heights.size()), 0.3e-6, 1e-10);
  }
}

// exp(-(x / length)^2), within what 2048 lengths can tell: about 1/sqrt(2048) = 0.02.
TEST(RoughProfile, HasAGaussianAutocorrelation) {
  const std::vector<double> heights = rough_heights(1, 5, 2048);
  for (const double lengths : {0.25, 0.5, 1.0, 1.5, 2.0, 4.0}) {
    const auto lag = static_cast<std::size_t>(lengths * stations_a_length);
    EXPECT_NEAR(autocorrelation(heights, lag), std::exp(-lengths * lengths), 0.05) << lengths;
  }
}

// For a normal law, Ra is sqrt(2/pi) of the root mean square.
TEST(RoughProfile, HasNormallyDistributedHeights) {
  const std::vector<double> heights = rough_heights(1, 6, 2048);
  double square = 0;
  for (const double h : heights) square += h * h / static_cast<double>(heights.size());
  EXPECT_NEAR(std::sqrt(square), std::sqrt(std::acos(-1.0) / 2), 0.02);
}

TEST(RoughProfile, IsTheSameForASeedAndAnotherForAnother) {
  const std::vector<double> one = rough_heights(1, 5, 64);
  EXPECT_EQ(one, rough_heights(1, 5, 64));
  EXPECT_NE(one, rough_heights(1, 6, 64));
}

const std::vector<std::string> rough{"tool.target.relief=rough", "tool.target.ra=0.2 mm",
                                     "tool.target.correlation_length=2 mm"};

Scene flat_with(std::vector<std::string> target, const std::vector<std::string>& more = {}) {
  target.insert(target.end(), more.begin(), more.end());
  return read_scene(paths::source_dir() + "/scenes/studies/scenes/shear-regular-held.toml", target);
}

double height_at(const std::vector<Vec2>& points, double x) {
  for (std::size_t i = 0; i + 1 < points.size(); ++i)
    if (x >= points[i].x() && x <= points[i + 1].x())
      return points[i].y() + (points[i + 1].y() - points[i].y()) * (x - points[i].x()) /
                                 (points[i + 1].x() - points[i].x());
  return std::nan("");
}

TEST(RoughProfile, GoesOnForTheWholeWay) {
  const std::vector<Vec2> points = flat_with(rough).tools.at(2).points;
  // Powder of 0 to 40 mm, a target that goes 8 mm to the right.
  EXPECT_LT(points.front().x(), -8e-3);
  EXPECT_GT(points.back().x(), 40e-3);
  double top = -1;
  for (std::size_t i = 2; i + 2 < points.size(); ++i) top = std::max(top, points[i].y());
  EXPECT_NEAR(top, 0, 1e-15);
  EXPECT_EQ(points.front().y(), 0);
}

// A longer way, or a wider powder, adds to the surface; what was there stays, but for its height as a whole.
TEST(RoughProfile, IsTheSameSurfaceForALongerWay) {
  const auto one = flat_with(rough).tools.at(2).points;
  const auto more = flat_with(rough, {"stage.shear.move.target.displacement=[\"20 mm\", \"0 mm\"]"})
                        .tools.at(2)
                        .points;
  const double lift = height_at(more, 10e-3) - height_at(one, 10e-3);
  for (double x = -7e-3; x < 40e-3; x += 1.7e-3)
    EXPECT_NEAR(height_at(more, x) - height_at(one, x), lift, 1e-15) << x;
}

// Powder that a holder carries over a target at rest comes as far as the holder goes.
TEST(GroovedProfile, GoesAsFarAsThePowderIsCarried) {
  const auto end_of = [](const char* way) {
    const Scene scene = own_scene(R"(extends = "shear/groove-law.toml"
remove = ["expect", "stage.slide.move"]
[[stage]]
name = "slide"
[[stage.move]]
tool = "holder"
displacement = [")" + std::string(way) +
                                  "\", \"0 mm\"]\n");
    for (const ToolSpec& tool : scene.tools)
      if (tool.name == "target") return tool.points.back().x();
    return std::nan("");
  };
  EXPECT_NEAR(end_of("120 mm") - end_of("40 mm"), 80e-3, 8.1e-3);  // whole pitches
}

TEST(RoughProfile, ComesFromTheScenesSeed) {
  const auto points = [](const char* seed) { return flat_with(rough, {seed}).tools.at(2).points; };
  EXPECT_EQ(points("seed=7"), points("seed=7"));
  EXPECT_NE(points("seed=7"), points("seed=8"));
}

// ---- measured -------------------------------------------------------------------------------------------
class MeasuredProfile : public testing::Test {
 protected:
  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::path(testing::TempDir()) / (std::string("profile_") + test->name());
    std::filesystem::create_directories(folder_);
    std::ofstream(folder_ / "scene.toml") << "extends = \"" << paths::source_dir()
                                          << "/scenes/studies/scenes/shear-regular-held.toml\"\n";
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  void write(const std::string& text) const { std::ofstream(folder_ / "surface.csv") << text; }

  // Waves of 4 mm, 0.1 mm high, on a tilt of 1%; from 0 to `length` in mm.
  void write_waves(double length) const {
    std::ofstream file(folder_ / "surface.csv");
    file << "x [mm], height [um]\n";
    for (int i = 0; i <= 5 * length; ++i)
      file << 0.2 * i << ", " << 50 * std::sin(std::acos(-1.0) * 0.1 * i) + 10 * 0.2 * i << "\n";
  }

  LoadedScene load(std::vector<std::string> more = {}) const {
    more.insert(more.end(), {"tool.target.relief=file", "tool.target.file=surface.csv",
                             "tool.target.point=[\"-10 mm\", \"0 mm\"]"});
    return load_scene(folder_ / "scene.toml", more);
  }
  std::string refusal(const std::vector<std::string>& more = {}) const {
    return message_of([&] { load(more); });
  }
  std::vector<Vec2> points(const std::vector<std::string>& more = {}) const {
    return load(more).scene.tools.at(2).points;
  }

  std::filesystem::path folder_;
};

TEST_F(MeasuredProfile, LiesWhereItsFirstStationIsPutAndIsLevelled) {
  write_waves(60);
  const std::vector<Vec2> level = points();
  // Crests of the sine at 1, 5, 9 mm from its beginning, all at one height but for the levelling of a sine
  // over whole periods, whose own line has a slope of some 3 um over the length.
  for (const double x : {-9e-3, 11e-3, 31e-3}) EXPECT_NEAR(height_at(level, x), 0, 10e-6) << x;
  for (const double x : {-7e-3, 13e-3}) EXPECT_NEAR(height_at(level, x), -0.1e-3, 10e-6) << x;
}

TEST_F(MeasuredProfile, IsPartOfTheScenesHash) {
  write_waves(60);
  const std::uint64_t one = load().hash;
  EXPECT_EQ(load().hash, one);
  write_waves(61);
  EXPECT_NE(load().hash, one);
}

TEST_F(MeasuredProfile, TooShortIsRefusedWithTheLengthWanted) {
  write_waves(45);
  const std::string text = refusal();
  EXPECT_THAT(text, HasSubstr("target"));
  EXPECT_THAT(text, HasSubstr("the profile is 0.045 m long"));
  EXPECT_THAT(text, HasSubstr("allowed: a profile of at least 0.049 m"));
  write_waves(60);
  EXPECT_EQ(refusal(), "");
  EXPECT_THAT(refusal({"stage.shear.move.target.displacement=[\"20 mm\", \"0 mm\"]"}),
              HasSubstr("at least 0.061 m"));
}

TEST_F(MeasuredProfile, OverhangIsRefusedWithItsLine) {
  write("x [mm], height [um]\n0, 1\n10, 2\n9.5, 3\n60, 0\n");
  EXPECT_THAT(refusal(), HasSubstr("surface.csv:4:1: x: x goes from 0.01 m back to 0.0095 m"));
  write("x [mm], height [um]\n0, 1\n10, 2\n10, 3\n60, 0\n");
  EXPECT_THAT(refusal(), HasSubstr("surface.csv:4:1: x"));
}

TEST_F(MeasuredProfile, BadFilesAreRefused) {
  EXPECT_THAT(refusal(), HasSubstr("surface.csv:1:1: table: there is no such file"));
  write("x [m], height [um]\n0, 1\n1e-200, 2\n2e-200, 0\n");
  EXPECT_THAT(refusal(), HasSubstr("allowed: at least 1e-12 m"));
  write("x, height\n0, 1\n10, 2\n60, 0\n");
  EXPECT_THAT(refusal(), HasSubstr("has no unit"));
  write("x [mm], z [um]\n0, 1\n10, 2\n60, 0\n");
  EXPECT_THAT(refusal(), HasSubstr("there is no such column"));
  write("x [mm], height [um]\n0, 1\n10, high\n60, 0\n");
  EXPECT_THAT(refusal(), HasSubstr("surface.csv:3:5: height: 'high'"));
  write("x [mm], height [um]\n0, 1\n10, 2\n");
  EXPECT_THAT(refusal(), HasSubstr("2 points, allowed: 3 to 20000"));
}

TEST_F(MeasuredProfile, PeaksSharperThanTheRoundingAreRefusedWithTheRadiusThatFits) {
  write("x [mm], height [um]\n0, 0\n10, 0\n10.1, 100\n10.2, 0\n60, 0\n");
  EXPECT_EQ(refusal(), "");
  EXPECT_THAT(refusal({"tool.target.rounding=0.5 mm"}),
              HasSubstr("rounding: the arcs at the ends"));
}

}  // namespace
}  // namespace pulvis
