// Laws of sizes, fractions, packings in files, and what is refused of them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "scenes/outlines/outline.hpp"
#include "scenes/outlines/portable.hpp"
#include "scenes/packing/packing_file.hpp"
#include "scenes/packing/place.hpp"
#include "scenes/packing/size_law.hpp"
#include "tests/helpers/random_scene.hpp"
#include "tests/helpers/right_scene.hpp"
#include "tests/helpers/wrong.hpp"

namespace pulvis {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

TEST(Portable, FunctionsAgreeWithTheLibrary) {
  for (double x = -7.9; x < 8; x += 0.0437) {
    EXPECT_NEAR(portable::normal_probability(x), 0.5 * std::erfc(-x / std::numbers::sqrt2), 1e-14);
  }
  for (const double p : {0.001, 0.2, 0.5, 0.9, 0.9999})
    EXPECT_NEAR(portable::normal_probability(portable::normal_quantile(p)), p, 1e-14);
}

struct Moments {
  double mean = 0, square = 0, deviation = 0;
};

Moments moments_of(const std::vector<SizeShare>& sizes) {
  Moments m;
  for (const SizeShare& s : sizes) {
    m.mean += s.share * s.size;
    m.square += s.share * s.size * s.size;
  }
  m.deviation = std::sqrt(m.square - m.mean * m.mean);
  return m;
}

SizeLaw law_of(SizeLaw::Kind kind, double mean, double deviation) {
  SizeLaw law;
  law.kind = kind;
  law.mean = mean;
  law.deviation = deviation;
  return law;
}

// Mean area is the law's own with any number of sizes; mean and spread converge to it.
TEST(SizeLaw, MomentsAreTheLaws) {
  SizeLaw uniform = law_of(SizeLaw::Kind::uniform, 0, 0);
  uniform.minimum = 2e-3;
  uniform.maximum = 6e-3;
  SizeLaw normal = law_of(SizeLaw::Kind::normal, 10e-3, 1e-3);
  normal.minimum = 2e-3;  // eight deviations: all of the law
  normal.maximum = 18e-3;
  const SizeLaw lognormal = law_of(SizeLaw::Kind::lognormal, 10e-3, 3e-3);
  const struct {
    SizeLaw law;
    double mean, deviation;
  } cases[] = {
      {uniform, 4e-3, 4e-3 / std::sqrt(12)}, {normal, 10e-3, 1e-3}, {lognormal, 10e-3, 3e-3}};
  for (const auto& c : cases) {
    const double square = c.mean * c.mean + c.deviation * c.deviation;
    EXPECT_NEAR(moments_of(sizes_of(c.law, {}, 8)).square / square, 1, 2e-4);
    const Moments coarse = moments_of(sizes_of(c.law, {}, 8));
    const Moments fine = moments_of(sizes_of(c.law, {}, 128));
    EXPECT_NEAR(fine.mean / c.mean, 1, 1e-3);
    EXPECT_NEAR(fine.deviation / c.deviation, 1, 0.02);
    EXPECT_LT(coarse.deviation, fine.deviation);  // the spread inside the parts is lost
    EXPECT_NEAR(coarse.deviation / c.deviation, 1, 0.2);
  }
}

TEST(SizeLaw, CutOffIsKept) {
  SizeLaw law = law_of(SizeLaw::Kind::lognormal, 10e-3, 6e-3);
  law.minimum = 8e-3;
  law.maximum = 12e-3;
  for (const SizeShare& s : sizes_of(law, {}, 16)) {
    EXPECT_GT(s.size, 8e-3);
    EXPECT_LT(s.size, 12e-3);
  }
}

// The area of all particles below a size, over all area, lies on the curve at the borders of the parts.
TEST(SizeLaw, SieveCurveIsRecovered) {
  SizeLaw law;
  law.kind = SizeLaw::Kind::sieve;
  const SieveCurve curve{{1e-3, 0}, {2e-3, 0.2}, {4e-3, 0.7}, {5e-3, 1}};
  const std::vector<SizeShare> sizes = sizes_of(law, curve, 10);
  const double whole = moments_of(sizes).square;
  double passed = 0;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    const double s = sizes[i].size;
    passed += sizes[i].share * s * s / whole;
    EXPECT_NEAR(passed, 0.1 * static_cast<double>(i + 1), 1e-9);
    const double at = s < 2e-3   ? (s - 1e-3) * 200
                      : s < 4e-3 ? 0.2 + (s - 2e-3) * 250
                                 : 0.7 + (s - 4e-3) * 300;
    EXPECT_GT(at, passed - 0.1);
    EXPECT_LT(at, passed);
  }
}

TEST(SizeLaw, NumbersAddUp) {
  EXPECT_THAT(apportioned(10, {1, 1, 1}), testing::ElementsAre(4, 3, 3));
  EXPECT_THAT(apportioned(7, {0.5, 0.3, 0.2}), testing::ElementsAre(4, 2, 1));
}

class InFolder : public testing::Test {
 protected:
  void SetUp() override {
    folder = fs::temp_directory_path() /
             ("pulvis-mixture-" +
              std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    fs::create_directories(folder);
  }
  void TearDown() override { fs::remove_all(folder); }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder / name) << text;
  }
  Scene read(const std::string& text) const {
    return load_scene_text(text, folder / "s.toml").scene;
  }
  std::vector<SceneProblem> problems(const std::string& text) const {
    auto found = problems_in([&] { read(text); });
    EXPECT_FALSE(found.empty()) << "accepted";
    if (found.empty()) found.emplace_back();
    return found;
  }
  fs::path folder;
};
using PackingFile = InFolder;
using SieveFile = InFolder;

std::string sieved_scene() {
  return random_scene("width = \"60 mm\"\ndensity = 0.7\ncount = 80",
                      {{"semi", "distribution = \"sieve\"\nfile = \"sieve.csv\"\nsizes = 5"}},
                      "60 mm");
}

// Bodies, sizes and the top come back bit for bit.
TEST_F(PackingFile, ComesBackBitForBit) {
  write("sieve.csv", "size [mm], passing\n# coarse\n3, 0\n6, 0.6\n8, 1\n");
  const Scene made = read(sieved_scene());
  const std::vector<BodySpec> bodies = place_bodies(made);
  write("packing.csv", packing_text(made, bodies));
  std::string text = sieved_scene();
  const auto from = text.find("kind = \"random\""), to = text.find("[[tool]]");
  text.replace(from, to - from, "kind = \"csv\"\nfile = \"packing.csv\"\n\n");
  const Scene again = read(text);
  const std::vector<BodySpec> same = place_bodies(again);
  ASSERT_EQ(same.size(), 80U);
  ASSERT_EQ(again.particles.size(), made.particles.size());
  EXPECT_EQ(again.tools[3].point, made.tools[3].point);
  for (std::size_t i = 0; i < same.size(); ++i) {
    EXPECT_EQ(same[i].position, bodies[i].position);
    EXPECT_EQ(same[i].angle, bodies[i].angle);
    EXPECT_EQ(same[i].particle, bodies[i].particle);
    EXPECT_EQ(outline_area(again.particles[static_cast<std::size_t>(same[i].particle)].outline),
              outline_area(made.particles[static_cast<std::size_t>(bodies[i].particle)].outline));
  }
}

TEST_F(SieveFile, GivesSizesByLeastWidth) {
  write("sieve.csv", "size [mm],passing\n3,0\n6,0.6\n8,1\n");
  const Scene scene = read(sieved_scene());
  ASSERT_EQ(scene.particles.size(), 6U);
  double before = 3e-3;
  for (std::size_t p = 1; p < 6; ++p) {
    const auto& outline = std::get<RoundedRectangleOutline>(scene.particles[p].outline);
    EXPECT_GT(outline.height, before);
    EXPECT_NEAR(outline.width / outline.height, 1.5, 1e-12);
    before = outline.height;
  }
  EXPECT_LT(before, 8e-3);
}

TEST_F(SieveFile, IsRefusedAtItsLine) {
  const struct {
    const char *text, *says;
    int line;
  } cases[] = {{"size [mm],passing\n3,0.1\n6,1\n", "0.1 pass the smallest sieve, allowed: 0", 2},
               {"size [mm],passing\n3,0\n6,0.5\n5,1\n", "allowed: > 0.006 m", 4},
               {"size [mm],passing\n3,0\n6,0.5\n7,0.4\n", "allowed: >= 0.5", 4},
               {"size [mm],passing\n3,0\n6,0.5\n", "allowed: 1 in the last row", 3},
               {"size [mm],passing\n1e-20,0\n6,1\n", "allowed: >= 1e-12 m", 2},
               {"size,passing\n3,0\n6,1\n", "has no unit, allowed: one that converts to m", 1},
               {"size [kg],passing\n3,0\n6,1\n", "allowed: a unit that converts to m", 1},
               {"size [mm],passing\n3,0\n6\n", "has 1 fields, allowed: 2", 3},
               {"size [mm],passing\n3,0\nsix,1\n", "'six' is not a finite number", 3},
               {"size [mm],passed\n3,0\n6,1\n", "the column is unknown, allowed: size, passing", 1},
               {"", "is empty", 1}};
  for (const auto& c : cases) {
    write("sieve.csv", c.text);
    const SceneProblem problem = problems(sieved_scene()).front();
    EXPECT_EQ(problem.line, c.line) << problem.text();
    EXPECT_THAT(problem.message, HasSubstr(c.says));
    EXPECT_THAT(problem.file, HasSubstr("sieve.csv"));
  }
  fs::remove(folder / "sieve.csv");
  EXPECT_THAT(problems(sieved_scene()).front().message, HasSubstr("there is no such file"));
}

// A study keeps a run as long as its hash is the same: not when the powder has changed.
TEST_F(SieveFile, BelongsToTheHashOfItsScene) {
  const auto hash = [&] { return load_scene_text(sieved_scene(), folder / "s.toml").hash; };
  write("sieve.csv", "size [mm],passing\n3,0\n6,0.6\n8,1\n");
  const std::uint64_t before = hash();
  EXPECT_EQ(hash(), before);
  write("sieve.csv", "size [mm],passing\n3,0\n6,0.7\n8,1\n");
  EXPECT_NE(hash(), before);
}

TEST_F(PackingFile, IsRefusedAtItsLine) {
  std::string text = random_scene("width = \"60 mm\"", {{"large", "number = 3"}}, "60 mm");
  const auto from = text.find("kind = \"random\""), to = text.find("[[tool]]");
  text.replace(from, to - from, "kind = \"csv\"\nfile = \"p.csv\"\n\n");
  write("p.csv", "class,x [mm],y [mm],angle [deg]\nlarge,5,5,0\nlarge,15,5,0\nlarg,25,5,0\n");
  const SceneProblem problem = problems(text).front();
  EXPECT_EQ(problem.line, 4);
  EXPECT_THAT(problem.message, HasSubstr("no particle is called 'larg', did you mean 'large'"));
  write("p.csv", "class,x [mm],y [mm],angle [deg]\nlarge,5,5,90\nlarge,15,5,0\n");
  const Scene scene = read(text);
  EXPECT_EQ(scene.tools[3].point.y(), 0.01);  // the punch rests on the highest particle
  EXPECT_NEAR(scene.packings[0].placed[0].angle, std::numbers::pi / 2, 1e-15);
}

struct WrongMixtureCase {
  const char* die;
  std::vector<RandomClass> classes;
  const char *key, *says;
};
const WrongMixtureCase wrong_mixtures[] = {
    {"width = \"60 mm\"\ndensity = 0.7",
     {},
     "packing[0]",
     "allowed: at least one [[packing.class]]"},
    {"width = \"60 mm\"\ndensity = 0.7\ncount = 9",
     {{"large", "number_fraction = 0.5"}, {"small", "number_fraction = 0.4"}},
     "packing[0].class[1].number_fraction",
     "add up to 0.9, allowed: 1"},
    {"width = \"60 mm\"\ndensity = 0.7\ncount = 9",
     {{"large", "number = 5"}, {"small", "number_fraction = 1"}},
     "packing[0]",
     "state their amounts in different ways"},
    {"width = \"60 mm\"\ndensity = 0.7\ncount = 3",
     {{"large", "number_fraction = 0.95"}, {"small", "number_fraction = 0.05"}},
     "packing[0].class[1].number_fraction",
     "no whole particle of this class remains"},
    {"width = \"9 mm\"\ndensity = 0.7",
     {{"large", "number = 5"}},
     "packing[0].width",
     "is 0.01 m wide and does not fit into the die, allowed: > 0.01 m"},
    {"width = \"60 mm\"",
     {{"large", "number = 5"}},
     "packing[0]",
     "the size of the packing is not determined, allowed: two of count"},
    {"width = \"60 mm\"\nheight = \"60 mm\"\ndensity = 0.7",
     {{"large", "number = 5"}},
     "packing[0].height",
     "follows from count and density"},
    {"width = \"60 mm\"\nheight = \"60 mm\"\ndensity = \"touching\"",
     {{"large", ""}},
     "packing[0].density",
     "does not determine the count"},
    {"width = \"60 mm\"\ndensity = 1.2",
     {{"large", "number = 5"}},
     "packing[0].density",
     "1.2 is out of range"},
    {"width = \"60 mm\"\ndensity = \"dense\"",
     {{"large", "number = 5"}},
     "packing[0].density",
     "\"touching\""},
    {"width = \"60 mm\"\ndensity = 0.7",
     {{"large", "number = 5\ndistribution = \"uniform\"\nminimum = \"3 mm\""}},
     "packing[0].class[0].maximum",
     "required key is missing"},
    {"width = \"60 mm\"\ndensity = 0.7",
     {{"large", "number = 5\ndistribution = \"normal\"\nmean = \"3 mm\"\ndeviation = \"2 mm\""}},
     "packing[0].class[0].deviation",
     "allowed: < 0.001 m"}};

TEST(WrongMixture, IsRefusedWithItsBound) {
  for (const auto& c : wrong_mixtures) {
    std::string text = random_scene(c.die, c.classes, "60 mm");
    if (c.classes.empty())
      text.insert(text.find("[[packing]]"),
                  random_particle("large") +
                      "[[body]]\nparticle = \"large\"\nposition = [\"9 mm\", \"9 mm\"]\n\n");
    bool told = false;
    for (const SceneProblem& problem : problems_of(text))
      told |= problem.key == c.key && problem.message.find(c.says) != std::string::npos;
    EXPECT_TRUE(told) << c.key << ": " << problems_of(text).front().text();
  }
}

}  // namespace
}  // namespace pulvis
