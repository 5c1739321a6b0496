// Bonds that a scene makes at its start: refused where there are none, told of where the mesh does not resolve how they
// break.
#include "scenes/checks/bond_checks.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "components/bond.hpp"
#include "tests/helpers/experiment.hpp"
#include "tests/helpers/wrong.hpp"

namespace pulvis {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

// The blocks of pulled-blocks.toml, so far apart. Their edges: 0.1 and 1/13 mm.
std::vector<SceneProblem> problems_apart(double gap, std::vector<std::string> more = {}) {
  more.push_back(fmt::format("body[1].position=[\"0 mm\", \"{} mm\"]", 1 + gap));
  more.push_back("tool.head.high=[\"0.6 mm\", \"2.6 mm\"]");
  return problems_in([&] { Experiment e("bonds/pulled-blocks.toml", more); });
}

TEST(InitialBonds, ThatBondNothingAreRefusedWithTheReachThatWouldDo) {
  EXPECT_THAT(problems_apart(0), IsEmpty());
  const auto problems = problems_apart(0.01);
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_EQ(problems[0].key, "bond[0].reach");
  EXPECT_EQ(problems[0].line, 46);
  EXPECT_THAT(problems[0].file, HasSubstr("pulled-blocks.toml"));
  EXPECT_THAT(problems[0].message, HasSubstr("the nearest surfaces are 1e-05 m apart"));
  // Of the longer edges, which bond first.
  const std::string allowed = "allowed: reach >= ";
  const auto at = problems[0].message.find(allowed);
  ASSERT_NE(at, std::string::npos) << problems[0].message;
  const double reach = std::stod(problems[0].message.substr(at + allowed.size()));
  EXPECT_NEAR(reach, 0.1, 2e-4);
  EXPECT_THAT(problems_apart(0.01, {fmt::format("bond[0].reach={}", reach)}), IsEmpty());
  EXPECT_EQ(problems_apart(0.01, {fmt::format("bond[0].reach={}", 0.99 * reach)}).size(), 1U);
}

TEST(InitialBonds, FarFromEachOtherAreLookedForAsFarAsTheReachGoes) {
  const auto problems = problems_apart(0.3);
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_THAT(problems[0].message, HasSubstr("face each other within"));
  EXPECT_THAT(problems_apart(0.045, {"bond[0].reach=0.5"}), IsEmpty());
}

TEST(InitialBonds, OfAToolThatIsApartAreRefused) {
  const auto problems_at = [](const char* height) {
    const std::string text = fmt::format(R"(
extends = "{}/scenes/bonds/pulled-blocks.toml"
remove = ["tool.base", "bond"]
[[bond]]
between = ["stone", "table"]
origin = "initial"
strength = "10 MPa"
fracture_energy = "20 J/m^2"
[[tool]]
name = "table"
shape = "plane"
point = ["0 mm", "{} mm"]
normal = [0, 1]
)",
                                         paths::source_dir(), height);
    return problems_in([&] { Experiment e(own_scene(text)); });
  };
  EXPECT_THAT(problems_at("-0.5"), IsEmpty());
  const auto problems = problems_at("-0.502");
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_THAT(problems[0].message, HasSubstr("no part of 'stone' and 'table' is bonded"));
  EXPECT_THAT(problems[0].message, HasSubstr("allowed: reach >= 0.02"));
}

// ---- names and grains ------------------------------------------------------------------------------------
TEST(BondsInside, WithoutGrainsAreRefusedWithTheReason) {
  const auto whole = problems_in(
      [] { own_scene("extends = \"bonds/pulled-blocks.toml\"\n", {"bond[0].inside=true"}); });
  ASSERT_EQ(whole.size(), 1U);
  EXPECT_EQ(whole[0].key, "bond[0].inside");
  EXPECT_EQ(whole[0].message,
            "it bonds the grains of one particle, but no particle of 'stone' and 'stone' has "
            "[particle.grains], allowed: false");
  const auto with = [](const char* pair) {
    return problems_in([&] {
      own_scene("extends = \"bonds/brazilian-disc.toml\"\n",
                {"bond[0].inside=true", std::string("bond[0].between=") + pair});
    });
  };
  EXPECT_THAT(with("[\"salt\", \"salt\"]"), IsEmpty());
  const auto tool = with("[\"salt\", \"top\"]");
  ASSERT_EQ(tool.size(), 1U);
  EXPECT_THAT(tool[0].message, HasSubstr("allowed: false, or between = [\"salt\", \"salt\"]"));
}

// A name that the message offers is accepted.
TEST(BondsBetween, UnknownNamesAreToldThoseOfSurfaces) {
  const auto told = [](const char* pair) {
    return message_of([&] {
      own_scene("extends = \"bonds/pulled-blocks.toml\"\n",
                {std::string("bond[0].between=") + pair});
    });
  };
  const std::string unknown = told("[\"stone\", \"hed\"]");
  EXPECT_THAT(unknown, HasSubstr("no material or tool is called \"hed\", allowed: stone"));
  EXPECT_THAT(unknown, ::testing::Not(HasSubstr("head")));
  EXPECT_THAT(told("[\"stone\", \"head\"]"), HasSubstr("the constraint 'head' has no contact"));
}

// ---- random strengths ------------------------------------------------------------------------------------
// P(s > s_max) = exp(-s_max^m): 10.5% for s_max = 1.5, m = 2.
TEST(RandomStrengths, ThatAreCutOffAreToldOf) {
  const char* const scene = "bonds/pulled-blocks.toml";
  Experiment as_shipped(scene, {"bond[0].weibull_modulus=2"});
  const auto& law = as_shipped.simulation.world().resource<BondRules>().laws[0];
  const std::string energy =
      fmt::format("bond[0].fracture_energy={} J/m^2", 1.5 * law.energy / law.largest_share);
  const auto lines = [&](const std::vector<std::string>& changes) {
    std::vector<std::string> all{energy};
    all.insert(all.end(), changes.begin(), changes.end());
    Experiment e(scene, all);
    auto told = bond_warnings(e.scene, e.simulation.world());
    std::erase_if(told, [](const std::string& line) {
      return line.find("random strengths") == std::string::npos;
    });
    return told;
  };
  const auto cut = lines({"bond[0].weibull_modulus=2"});
  ASSERT_EQ(cut.size(), 1U);
  EXPECT_THAT(cut[0], HasSubstr("cut off at 1.5 times `strength`, which 11% of the pairs reach"));
  EXPECT_THAT(lines({"bond[0].weibull_modulus=10"}), IsEmpty());
  EXPECT_THAT(lines({}), IsEmpty());
  const std::string stiffer = fmt::format("bond[0].stiffness={}", 1.44 * law.stiffness);
  EXPECT_THAT(lines({"bond[0].weibull_modulus=2", stiffer}), IsEmpty());
}

// ---- the zone over which they break ----------------------------------------------------------------------
std::vector<std::string> warnings(const char* scene, const std::vector<std::string>& overrides) {
  Experiment e(scene, overrides);
  return bond_warnings(e.scene, e.simulation.world());
}

TEST(CohesiveZone, OfThreeEdgesAndMoreIsNotToldOf) {
  EXPECT_THAT(warnings("bonds/double-cantilever.toml", {}), IsEmpty());
  // 0.88 E' G/sigma^2 = 0.9387 mm: three edges of 10 mm/32.
  EXPECT_THAT(warnings("bonds/double-cantilever.toml", {"particle.arm.mesh.columns=32"}),
              IsEmpty());
  const auto coarse = warnings("bonds/double-cantilever.toml", {"particle.arm.mesh.columns=31"});
  ASSERT_EQ(coarse.size(), 1U);
  EXPECT_THAT(coarse[0], HasSubstr("bond[0] between 'glued' and 'glued': the cohesive zone ahead "
                                   "of a crack spans 2.91 boundary"));
  EXPECT_THAT(coarse[0], HasSubstr("use edges of 0.000313 m"));
}

TEST(CohesiveZone, LongerThanTheInterfaceIsNotToldOf) {
  // Interface 1 mm, zone 3.75 mm.
  EXPECT_THAT(warnings("bonds/pulled-blocks.toml", {"particle.upper.mesh.columns=3"}), IsEmpty());
  // Zone 0.60 mm of edges of 1/3 and 0.25 mm; of one edge there is no crack along it.
  const auto brittle = [](int columns) {
    return warnings(
        "bonds/pulled-blocks.toml",
        {"bond[0].strength=25 MPa", fmt::format("particle.upper.mesh.columns={}", columns),
         fmt::format("particle.lower.mesh.columns={}", columns)});
  };
  EXPECT_EQ(brittle(3).size(), 1U);
  EXPECT_EQ(brittle(4).size(), 1U);
  EXPECT_THAT(brittle(6), IsEmpty());
  EXPECT_THAT(brittle(1), IsEmpty());
}

TEST(CohesiveZone, IsTheShorterOfBothModes) {
  EXPECT_THAT(warnings("bonds/double-cantilever.toml", {"bond[0].shear_strength=25 MPa"}),
              IsEmpty());
  EXPECT_EQ(warnings("bonds/double-cantilever.toml", {"bond[0].shear_strength=40 MPa"}).size(), 1U);
}

}  // namespace
}  // namespace pulvis
