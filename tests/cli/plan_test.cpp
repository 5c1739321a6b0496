// What a scene switches on: the columns it is given and the systems and edges that follow from them.
// A column or a system that the scene does not need would cost memory or time in every step.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "components/bond.hpp"
#include "components/observed.hpp"
#include "tests/helpers/experiment.hpp"

namespace pulvis {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::IsSubsetOf;
using ::testing::IsSupersetOf;
using ::testing::Not;
using ::testing::UnorderedElementsAreArray;
using Names = std::set<std::string>;

// The columns of a scene's world and the systems of its step, by name.
struct Asked {
  explicit Asked(const std::string& scene_file, const std::vector<std::string>& overrides = {})
      : experiment(scene_file, overrides), list(step_list(experiment.simulation.world())) {
    for (const ColumnBase* c : experiment.simulation.world().columns())
      columns.insert(c->entity + "/" + c->info.name);
    for (const auto* part : {&list.forces, &list.observe, &list.motion})
      for (const System& system : *part) {
        names.insert(system.name);
        systems.push_back(&system);
      }
  }

  // Columns whose own name (without the place) is one of `words`.
  Names called(const Names& words) const {
    Names found;
    for (const std::string& column : columns)
      if (words.contains(column.substr(column.find('/') + 1))) found.insert(column);
    return found;
  }
  // Columns of these places.
  Names at(const Names& places) const {
    Names found;
    for (const std::string& column : columns)
      if (places.contains(column.substr(0, column.find('/')))) found.insert(column);
    return found;
  }

  Experiment experiment;
  StepList list;
  std::vector<const System*> systems;
  Names columns, names;
};

const Names plastic_columns{"cp_inverse",      "plastic_strain", "plastic_work",
                            "isochoric_scale", "yield_stress",   "hardening_modulus"};
const Names friction_columns{"elastic_slip", "slope_load"};
const Names contact_places{"contact", "tool_contact", "curve", "boundary", "tool"};
const Names contact_systems{"tool_motion",   "bin_edges",     "bin_tool_edges", "skin_check",
                            "edge_contact",  "tool_contact",  "contact_totals", "contact_health",
                            "tool_reaction", "contact_force", "contact_curve"};

TEST(Plan, ElasticSceneHasNothingPlastic) {
  const Asked asked("basic/patch-test.toml");
  EXPECT_THAT(asked.called(plastic_columns), IsEmpty());
  EXPECT_THAT(asked.names, Not(Contains("j2_return_map")));
  EXPECT_THAT(asked.names, Not(Contains("trial_stress")));
  EXPECT_THAT(asked.names, Not(Contains("plastic_work")));
  EXPECT_THAT(asked.names, Contains("elastic_stress"));
}

TEST(Plan, FrictionlessSceneKeepsNoFrictionHistory) {
  for (const char* scene : {"basic/patch-test.toml", "compaction/unit-cell.toml"})
    EXPECT_THAT(Asked(scene).called(friction_columns), IsEmpty()) << scene;
  EXPECT_THAT(Asked("compaction/regular-25.toml", {"contact.friction=0"}).called(friction_columns),
              IsEmpty());
}

// Without friction or damping nobody asks how fast the surfaces move.
TEST(Plan, VelocitiesOfTheOutlineOnlyWhereAContactLawAsksForThem) {
  const std::vector<std::string> smooth{"contact.friction=0", "contact.damping=0"};
  EXPECT_THAT(Asked("compaction/regular-25.toml", smooth).columns, Not(Contains("curve/velocity")));
  EXPECT_THAT(Asked("compaction/regular-25.toml").columns, Contains("curve/velocity"));
}

TEST(Plan, PlasticSceneWithFrictionHasBoth) {
  const Asked asked("compaction/regular-25.toml");
  EXPECT_THAT(asked.called(plastic_columns),
              UnorderedElementsAreArray({"element/cp_inverse", "element/plastic_strain",
                                         "element/isochoric_scale", "particle/plastic_work",
                                         "particle/yield_stress", "particle/hardening_modulus"}));
  EXPECT_THAT(asked.called(friction_columns),
              UnorderedElementsAreArray(
                  {"contact/elastic_slip", "contact/slope_load", "tool_contact/elastic_slip"}));
  EXPECT_THAT(asked.names, IsSupersetOf({"trial_stress", "j2_return_map", "plastic_work"}));
  EXPECT_THAT(asked.names, Not(Contains("elastic_stress")));
}

// The coefficient lies with the other constants of a row: damping asks for the velocities and nothing else.
TEST(Plan, DampingAsksForTheVelocitiesOfTheOutlineOnly) {
  Names expected =
      Asked("compaction/regular-25.toml", {"contact.friction=0", "contact.damping=0"}).columns;
  expected.insert("curve/velocity");
  EXPECT_EQ(Asked("compaction/regular-25.toml", {"contact.friction=0"}).columns, expected);
}

TEST(Plan, FreeParticleHasNoContact) {
  const Asked asked("basic/spinning-disc.toml");
  EXPECT_THAT(asked.at(contact_places), IsEmpty());
  EXPECT_THAT(asked.names, ElementsAre("advance_clock", "elastic_energy", "elastic_stress",
                                       "element_health", "hourglass_energy", "integrate",
                                       "internal_force", "kinetic_energy", "stable_time_step"));
}

TEST(Plan, OneParticleBetweenToolsHasNoPairs) {
  const Asked asked("compaction/unit-cell.toml");
  EXPECT_THAT(asked.at({"contact"}), IsEmpty());
  EXPECT_THAT(asked.names, Not(Contains("edge_contact")));
  EXPECT_THAT(asked.names, Not(Contains("bin_edges")));
  EXPECT_THAT(asked.names, Contains("tool_contact"));
}

TEST(Plan, ParticlesWithoutToolsHaveNoToolContact) {
  const Asked asked("basic/oblique-impact.toml");
  EXPECT_THAT(asked.at({"tool", "tool_contact"}), IsEmpty());
  for (const char* name : {"tool_motion", "bin_tool_edges", "tool_contact", "tool_reaction"})
    EXPECT_THAT(asked.names, Not(Contains(name)));
  EXPECT_THAT(asked.names, Contains("edge_contact"));
}

TEST(Plan, SceneWithEverythingHasEveryContactSystem) {
  EXPECT_THAT(contact_systems, IsSubsetOf(Asked("compaction/regular-25.toml").names));
}

// What is observed beyond forces and energies costs nothing where nobody asks for it.
const Names observing{"particle_stress", "contact_network", "force_chains", "local_density"};

Names observing_systems(const Asked& asked) {
  Names found;
  for (const std::string& name : asked.names)
    if (observing.contains(name)) found.insert(name);
  return found;
}

TEST(Plan, ObservesNothingMoreUnlessAsked) {
  const Asked asked("compaction/regular-25.toml");
  EXPECT_THAT(observing_systems(asked), IsEmpty());
  EXPECT_THAT(asked.called({"stress", "deformed_area", "centre"}), IsEmpty());
  const World& world = const_cast<Simulation&>(asked.experiment.simulation).world();
  EXPECT_FALSE(world.has<ContactNetwork<TwoD>>());
  EXPECT_FALSE(world.has<DensityGrid>());
}

TEST(Plan, ObservesWhatIsAskedOnSampledStepsOnly) {
  const std::string scene = "compaction/regular-25.toml";
  const Asked density(scene, {"output.density_cells=[5, 5]"});
  EXPECT_THAT(observing_systems(density), ElementsAre("local_density"));
  EXPECT_THAT(density.called({"stress", "deformed_area", "centre"}), IsEmpty());
  EXPECT_THAT(observing_systems(Asked(scene, {"output.particle_stress=true"})),
              ElementsAre("particle_stress"));
  const Asked contacts(scene, {"output.contacts=true"});
  EXPECT_THAT(observing_systems(contacts),
              ElementsAre("contact_network", "force_chains", "particle_stress"));
  for (const System& system : contacts.list.observe) EXPECT_EQ(system.when, When::on_sample);
  for (const StagePlan& stage : contacts.experiment.simulation.plan().stages)
    for (const std::string& system : stage.systems) EXPECT_FALSE(observing.contains(system));
}

TEST(Plan, ObservesInSpaceWhatIsAskedAndOnSampledStepsOnly) {
  const std::string scene = "compaction-3d/unit-cell-sc.toml";
  EXPECT_THAT(observing_systems(Asked(scene)), IsEmpty());
  EXPECT_THAT(observing_systems(Asked(scene, {"output.density_cells=[2, 2, 2]"})),
              ElementsAre("local_density"));
  const Asked contacts(scene, {"output.contacts=true"});
  EXPECT_THAT(observing_systems(contacts),
              ElementsAre("contact_network", "force_chains", "particle_stress"));
  for (const System& system : contacts.list.observe) EXPECT_EQ(system.when, When::on_sample);
  for (const StagePlan& stage : contacts.experiment.simulation.plan().stages)
    for (const std::string& system : stage.systems) EXPECT_FALSE(observing.contains(system));
}

TEST(Plan, FragmentsAreLookedForWithBondsOnlyAndOnSampledStepsOnly) {
  const Asked without("compaction/regular-25.toml"), with("bonds/pulled-blocks.toml");
  const auto has_fragments = [](const Asked& asked) {
    return const_cast<Simulation&>(asked.experiment.simulation).world().has<Fragments>();
  };
  EXPECT_THAT(without.names, Not(Contains("fragments")));
  EXPECT_FALSE(has_fragments(without));
  EXPECT_THAT(with.names, Contains("fragments"));
  EXPECT_TRUE(has_fragments(with));
  for (const StagePlan& stage : with.experiment.simulation.plan().stages)
    EXPECT_THAT(stage.systems, Not(Contains("fragments")));
}

// ---- the graph ----------------------------------------------------------------------------------
std::vector<std::string> edges_by_name(const GraphPlan& plan) {
  const auto name = [&](int stage) {
    return plan.stages[static_cast<std::size_t>(stage)].systems[0];
  };
  std::vector<std::string> edges;
  for (const auto& [earlier, later] : plan.edges)
    edges.push_back(name(earlier) + " -> " + name(later));
  return edges;
}

// A stage is called by its first system: contact_force stands for all that is fused behind it.
TEST(Plan, EdgesOfACompactionStep) {
  const Asked asked("compaction/regular-25.toml");
  EXPECT_THAT(edges_by_name(asked.experiment.simulation.plan()),
              UnorderedElementsAreArray({
                  "tool_motion -> skin_check",       // where the tools are
                  "skin_check -> bin_edges",         // contact_index
                  "bin_edges -> bin_tool_edges",     // contact_index
                  "bin_edges -> edge_contact",       // the rows
                  "bin_tool_edges -> tool_contact",  // the rows
                  "edge_contact -> contact_totals",  // energies of the rows
                  "edge_contact -> contact_force",   // forces of the points
                  "tool_contact -> contact_totals", "tool_contact -> contact_force",
                  "contact_totals -> contact_health",  // totals
                  "contact_health -> tool_reaction",   // totals
                  "tool_reaction -> element_health",   // totals
                  "trial_stress -> contact_force",     // internal_force
                  "trial_stress -> element_health",    // min_jacobian
                  "contact_force -> advance_clock",    // stable_dt
                  "element_health -> advance_clock",   // clock
              }));
}

// The two narrow phases, the stresses of the bodies and the sums over the rows run side by side.
TEST(Plan, IndependentStagesHaveNoPathBetweenThem) {
  const Asked asked("compaction/regular-25.toml");
  const GraphPlan& plan = asked.experiment.simulation.plan();
  const auto stage = [&](const std::string& name) {
    for (int s = 0; s < static_cast<int>(plan.stages.size()); ++s)
      for (const std::string& system : plan.stages[static_cast<std::size_t>(s)].systems)
        if (system == name) return s;
    throw std::logic_error("no stage runs " + name);
  };
  std::set<std::pair<int, int>> reach(plan.edges.begin(), plan.edges.end());
  for (bool grows = true; grows;) {
    grows = false;
    for (const auto& [a, b] : std::set(reach))
      for (const auto& [c, d] : plan.edges)
        if (b == c && reach.emplace(a, d).second) grows = true;
  }
  EXPECT_FALSE(reach.contains({stage("edge_contact"), stage("tool_contact")}));
  for (const char* rows : {"edge_contact", "tool_contact", "tool_reaction"}) {
    EXPECT_FALSE(reach.contains({stage(rows), stage("internal_force")})) << rows;
    EXPECT_FALSE(reach.contains({stage("internal_force"), stage(rows)})) << rows;
  }
  EXPECT_TRUE(reach.contains({stage("bin_edges"), stage("advance_clock")}));
}

TEST(Plan, BodiesAreComputedInTwoPassesOverTheChunks) {
  const Asked asked("compaction/regular-25.toml");
  std::vector<std::vector<std::string>> passes;
  for (const StagePlan& stage : asked.experiment.simulation.plan().stages)
    if (stage.by_chunk) passes.push_back(stage.systems);
  EXPECT_THAT(passes, ElementsAre(ElementsAre("trial_stress", "j2_return_map", "internal_force",
                                              "stable_time_step", "highest_mode"),
                                  ElementsAre("contact_force", "integrate", "contact_curve",
                                              "surface_hardness")));
}

// ---- no idle column -----------------------------------------------------------------------------
// Read by the results: history, frames.
const Names shown{"tool/force",
                  "tool/position",
                  "particle/kinetic_energy",
                  "particle/elastic_energy",
                  "particle/plastic_work",
                  "particle/hourglass_energy",
                  "particle/damping_work"};
// Read and written by one and the same system through Write: history of a contact row, sums.
const Names kept_by_their_writer{"contact/activation",   "tool_contact/activation",
                                 "contact/elastic_slip", "tool_contact/elastic_slip",
                                 "contact/indentation",  "tool_contact/indentation",
                                 "curve/force",          "curve/before",
                                 "node/damping_force",   "node/highest_mode",
                                 "particle/mode_gain"};

class NoIdleColumn : public ::testing::TestWithParam<const char*> {};

TEST_P(NoIdleColumn, EveryColumnIsReadBySomebody) {
  const Asked asked(GetParam());
  Names read;
  for (const System* system : asked.systems)
    for (const AccessInfo& access : system->accesses)
      if (access.mode == AccessMode::read) read.insert(access.name);
  for (const std::string& column : asked.columns)
    EXPECT_TRUE(read.contains(column) || shown.contains(column) ||
                kept_by_their_writer.contains(column))
        << column;
}

// And none is only read: what nobody writes was set once by the scene.
TEST_P(NoIdleColumn, EveryColumnIsWrittenBySomebodyOrByTheScene) {
  const Names of_the_scene{"particle/shear_modulus",
                           "particle/bulk_modulus",
                           "particle/density",
                           "particle/yield_stress",
                           "tool/normal",
                           "particle/hardening_modulus",
                           "particle/mass_damping",
                           "particle/stiffness_damping",
                           "boundary/contact_support",
                           "node/inertance",
                           "constrained_node/direction",
                           "constrained_node/origin",
                           "constrained_node/target",
                           "constrained_node/travel"};
  const Asked asked(GetParam());
  Names written;
  for (const System* system : asked.systems)
    for (const AccessInfo& access : system->accesses)
      if (access.mode == AccessMode::write) written.insert(access.name);
  for (const std::string& column : asked.columns)
    EXPECT_TRUE(written.contains(column) || of_the_scene.contains(column)) << column;
}

INSTANTIATE_TEST_SUITE_P(ShippedScenes, NoIdleColumn,
                         ::testing::Values("basic/spinning-disc.toml", "basic/oblique-impact.toml",
                                           "basic/patch-test.toml", "basic/sliding-block.toml",
                                           "basic/damped-strut.toml", "compaction/unit-cell.toml",
                                           "compaction/regular-25.toml"));

}  // namespace
}  // namespace pulvis
