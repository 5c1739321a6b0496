// What a run says of its own figures: each beyond its limit comes with what to do.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scenes/results/run_quality.hpp"
#include "tests/helpers/experiment.hpp"

namespace pulvis {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

std::vector<QualityFigure> judged(const std::string& scene,
                                  const std::vector<std::string>& changes) {
  Experiment e(scene, changes);
  ContactLoading loading(e.scene);
  e.run(100, [&] { loading.sample(e.results, e.simulation.world()); });
  return run_quality(e.scene, e.simulation.world(), e.results, loading.findings());
}

QualityFigure figure(const std::vector<QualityFigure>& figures, const std::string& name) {
  for (const QualityFigure& one : figures)
    if (one.name == name) return one;
  ADD_FAILURE() << "no " << name;
  return {};
}

// 20 um of approach of a disc of 10 mm, with contacts that are too soft and a mesh that is too coarse.
std::vector<std::string> soft() {
  return {"particle.disc.mesh.refinement=1",
          "particle.disc.mesh.core=coarse",
          "particle.disc.mesh.rings=1",
          "particle.disc.mesh.boundary_edges=48",
          "contact.stiffness=0.5",
          "stage.press.move.top.displacement=[\"0 mm\", \"-0.01 mm\"]",
          "stage.press.move.bottom.displacement=[\"0 mm\", \"0.01 mm\"]"};
}

TEST(RunQuality, TellsWhatToDoBeyondALimitAndNothingWithin) {
  const auto figures = judged("basic/disc-platens.toml", soft());
  int beyond = 0;
  for (const QualityFigure& one : figures) {
    EXPECT_EQ(one.advice.empty(), !one.beyond()) << one.name;
    beyond += one.beyond();
  }
  EXPECT_GE(beyond, 2);
  const QualityFigure lost = figure(figures, "Force error due to penalty penetration");
  EXPECT_THAT(lost.line(), StartsWith("force error due to penalty penetration "));
  EXPECT_THAT(lost.line(), HasSubstr("% (limit 5%): use contact.stiffness = 10"));
  EXPECT_THAT(figure(figures, "Contacts narrower than two edges").line(),
              HasSubstr("edges of at most "));
  EXPECT_THAT(figure(figures, "Energy balance error").advice, IsEmpty());
}

// Done as it says, there is nothing left to say.
TEST(RunQuality, IsContentWithStiffContactsAFineMeshAndFourPoints) {
  auto changes = soft();
  changes[3] = "particle.disc.mesh.boundary_edges=384";
  changes[4] = "contact.stiffness=40";
  changes.emplace_back("element.formulation=four-point");
  for (const QualityFigure& one : judged("basic/disc-platens.toml", changes))
    EXPECT_FALSE(one.beyond()) << one.line();
}

// Whatever sets the resolution of the meshes, the advised keys can be set. Draft discs pressed between platens bend enough.
TEST(RunQuality, AdvisesOfKeysThatTheSceneAccepts) {
  auto changes = soft();
  changes[3] = "particle.disc.mesh.boundary_edges=24";
  changes[2] = "particle.disc.mesh.rings=0";
  changes[4] = "contact.stiffness=20";
  changes[5] = "stage.press.move.top.displacement=[\"0 mm\", \"-1.5 mm\"]";
  changes[6] = "stage.press.move.bottom.displacement=[\"0 mm\", \"1.5 mm\"]";
  const QualityFigure bent = figure(judged("basic/disc-platens.toml", changes), "Hourglass energy");
  ASSERT_TRUE(bent.beyond()) << bent.line();
  EXPECT_THAT(bent.advice, HasSubstr("(boundary_edges and rings of [particle.mesh], in place of "));
  EXPECT_THAT(bent.advice, HasSubstr("element.formulation = \"four-point\""));
  const auto keys = [](const char* scene) {
    return refining_keys(read_scene(paths::source_dir() + "/scenes/" + scene));
  };
  EXPECT_EQ(keys("bonds/brazilian-disc.toml"), "edges of [particle.grains]");
  EXPECT_EQ(keys("bonds/pulled-blocks.toml"), "columns and rows of [particle.mesh]");
}

// Its elements bend at contacts of any mesh: a figure to look at, not a warning that no mesh silences.
TEST(RunQuality, GivesTheHourglassEnergyOfHexahedraWithoutALimit) {
  const QualityFigure bent = figure(judged("extreme/space-box-rd-97.toml", {}), "Hourglass energy");
  EXPECT_GT(bent.value, 0.03);
  EXPECT_FALSE(bent.limit);
  EXPECT_EQ(bent.advice, "");
}

// A contact of two faces a plane, and one of many.
TEST(RunQuality, AsksForSmallerFacesWhereContactsInSpaceAreNarrow) {
  const QualityFigure first =
      figure(judged("compaction-3d/one-sphere.toml",
                    {"contact.hardness=1000", "stage.press.duration=20 us",
                     "stage.press.move.top.displacement=[\"0 mm\", \"0 mm\", \"-0.2 mm\"]"}),
             "Contacts narrower than two faces");
  EXPECT_GT(first.value, 0.99);
  EXPECT_THAT(first.advice, HasSubstr("faces wide on average: use faces of "));
  EXPECT_THAT(first.advice, HasSubstr(" um (particle.mesh.divisions)"));
  EXPECT_EQ(
      figure(judged("extreme/space-box-rd-97.toml", {}), "Contacts narrower than two faces").value,
      0);
}

// With 32% of the force on contacts of one to two edges that of 25 discs is 3% off where they indent, as good as without
// any such contact and soft springs (4%).
TEST(RunQuality, DoesNotAskForFinerMeshesOfContactsThatIndent) {
  using Changes = std::vector<std::string>;
  const auto narrow = [](const Changes& more) {
    Changes changes{"stage.press.duration=0.3 ms",
                    "stage.press.move.top.displacement=[\"0 mm\", \"-0.5 mm\"]"};
    changes.insert(changes.end(), more.begin(), more.end());
    return figure(judged("compaction/regular-25.toml", changes),
                  "Contacts narrower than two edges");
  };
  const QualityFigure indents = narrow({}), hard = narrow({"contact.hardness=1000"});
  EXPECT_GT(indents.value, ContactFindings::most_narrow);
  EXPECT_FALSE(indents.limit);
  EXPECT_EQ(indents.advice, "");
  EXPECT_TRUE(hard.beyond()) << hard.value;
}

// Of a powder in three dimensions stiffness alone is no help: coarse faces bear too much.
TEST(RunQuality, AsksForSmallerFacesWithStifferContactsOfAPowder) {
  const auto figures = judged("extreme/space-box-rd-97.toml", {"contact.stiffness=0.5"});
  EXPECT_THAT(figure(figures, "Force error due to penalty penetration").advice,
              StartsWith("use contact.stiffness = 10, with smaller faces "));
}

TEST(RunQuality, HasTheLimitsOfTheScene) {
  auto changes = soft();
  changes.emplace_back("limits.penetration=0.4");
  changes.emplace_back("limits.kinetic_energy=0.5");
  const auto figures = judged("basic/disc-platens.toml", changes);
  EXPECT_EQ(figure(figures, "Penetration").limit, 0.4);
  EXPECT_EQ(figure(figures, "Kinetic energy").limit, 0.5);
  EXPECT_EQ(figure(judged("basic/disc-platens.toml", soft()), "Kinetic energy").limit, 0.1);
}

// Of disc-platens.
std::vector<std::string> coarse_disc() {
  return {"particle.disc.mesh.boundary_edges=40", "particle.disc.mesh.rings=2",
          "particle.disc.mesh.refinement=1"};
}

std::vector<std::string> with(std::vector<std::string> changes, const char* more) {
  changes.emplace_back(more);
  return changes;
}

// The largest ratio under more than a tenth of the largest force, in both dimensions: at first touch it is larger.
TEST(RunQuality, JudgesKineticEnergyUnderLoad) {
  using Changes = std::vector<std::string>;
  for (const auto& [scene, changes] : {std::pair("basic/disc-platens.toml", coarse_disc()),
                                       {"compaction-3d/one-sphere.toml",
                                        Changes{"accuracy=draft", "stage.press.duration=1 ms"}}}) {
    // With soft springs the sample at first touch bears less than a tenth of the load.
    Experiment e(scene, with(with(changes, "contact.stiffness=0.5"), "output.samples=400"));
    const std::string force = e.scene.in_space() ? "tool/top/force_z" : "tool/top/force_y";
    const std::string other = e.scene.in_space() ? "tool/bottom/force_z" : "tool/bottom/force_y";
    struct Sample {
      double load, internal, ratio;
    };
    std::vector<Sample> samples;
    double largest = 0, most_internal = 0, at_first_touch = 0;
    e.run(400, [&] {
      const double load = std::max(std::abs(e.value(force)), std::abs(e.value(other)));
      const double internal = e.results.energies().internal() + e.results.energies().contact;
      largest = std::max(largest, load);
      most_internal = std::max(most_internal, internal);
      if (!(internal > 0)) return;
      samples.push_back({load, internal, e.results.energies().kinetic / internal});
      at_first_touch = std::max(at_first_touch, samples.back().ratio);
    });
    double under_load = 0;
    for (const auto& [load, internal, ratio] : samples)
      if (load > 0.1 * largest && internal > 0.01 * most_internal)
        under_load = std::max(under_load, ratio);
    EXPECT_NEAR(e.results.kinetic_ratio() / under_load, 1, 1e-6) << scene;
    EXPECT_LT(e.results.kinetic_ratio(), at_first_touch) << scene;
    EXPECT_GT(e.results.kinetic_ratio(), 0) << scene;
  }
}

// In both dimensions.
TEST(RunQuality, TellsOfAPunchThatIsTooFast) {
  const QualityFigure plane =
      figure(judged("basic/disc-platens.toml", with(coarse_disc(), "stage.press.duration=5 us")),
             "Kinetic energy");
  EXPECT_TRUE(plane.beyond()) << plane.value;
  EXPECT_THAT(plane.line(), HasSubstr("% (limit 10%): move the tools more slowly"));
  const QualityFigure space = figure(
      judged("compaction-3d/one-sphere.toml", {"accuracy=draft", "stage.press.duration=20 us"}),
      "Kinetic energy");
  EXPECT_TRUE(space.beyond()) << space.value;
}

// Bodies that fly and collide are judged only if their scene says so.
TEST(RunQuality, DoesNotJudgeTheKineticEnergyOfCollisions) {
  EXPECT_FALSE(figure(judged("basic/oblique-impact.toml", {}), "Kinetic energy").limit);
  EXPECT_FALSE(figure(judged("extreme/space-impact-100-m-s.toml", {}), "Kinetic energy").limit);
  EXPECT_EQ(
      figure(judged("basic/oblique-impact.toml", {"limits.kinetic_energy=1e6"}), "Kinetic energy")
          .limit,
      1e6);
}

// In both dimensions; stiff contacts are within the limit, and a run that only loads has no such figure.
TEST(RunQuality, TellsWhatSpringsReleaseOnUnloading) {
  using Changes = std::vector<std::string>;
  for (const auto& [scene, changes, stiffness] :
       {std::tuple("extreme/springback-plastic.toml", Changes{}, "100"),
        {"compaction-3d/one-sphere.toml", {"accuracy=draft"}, "10"}}) {
    auto softer = changes;
    softer.emplace_back("contact.stiffness=0.5");
    const QualityFigure soft = figure(judged(scene, softer), release_figure);
    EXPECT_EQ(soft.limit, most_in_springs);
    EXPECT_TRUE(soft.beyond()) << scene << " " << soft.value;
    EXPECT_THAT(soft.line(),
                HasSubstr("use contact.stiffness = 10 (up to a quarter more CPU time"));
    auto stiffer = changes;
    stiffer.push_back(std::string("contact.stiffness=") + stiffness);
    const QualityFigure stiff = figure(judged(scene, stiffer), release_figure);
    EXPECT_FALSE(stiff.beyond()) << stiff.line();
  }
  for (const QualityFigure& one : judged("basic/disc-platens.toml", soft()))
    EXPECT_NE(one.name, release_figure);
}

// The largest of a series over the run, not its last value.
TEST(RunQuality, JudgesThePeaksOfTheRun) {
  Experiment e("basic/disc-platens.toml", soft());
  double penetration = 0, elastic = 0;
  e.run(100, [&] {
    penetration = std::max(penetration, e.value("penetration"));
    elastic = std::max(elastic, e.value("energy/elastic"));
  });
  EXPECT_GT(penetration, 0);
  EXPECT_EQ(e.results.peaks().penetration, penetration);
  EXPECT_EQ(e.results.peaks().elastic, elastic);
}

}  // namespace
}  // namespace pulvis
