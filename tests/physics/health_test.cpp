// A run that goes bad stops in the step in which it does, and says where: system, entity, step, value.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <regex>

#include "engine/run_failure.hpp"
#include "tests/helpers/experiment.hpp"
#include "tests/helpers/paths.hpp"
#include "tests/helpers/wrong.hpp"

namespace pulvis {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::StartsWith;

// What the failing run says; the step at which it stopped stays in the clock.
std::string failure_of(Simulation& simulation, std::int64_t max_steps) {
  return message_of<RunFailure>([&] { simulation.run_steps(max_steps); });
}

std::string step_now(const Simulation& simulation) {
  return "step " + std::to_string(simulation.clock().step) + ",";
}

// ---- too fast -------------------------------------------------------------------------------------
// 2 km/s: the punch is through the first row before the particles can get out of its way.
TEST(Health, AbsurdPunchIsNamedWithBothSides) {
  Experiment e("compaction/regular-25.toml",
               {"stage.press.duration=10 us",
                "stage.press.move[0].displacement=[\"0 mm\", \"-20 mm\"]", "contact.stiffness=0.5"},
               2);
  const std::string failure = failure_of(e.simulation, 10000);
  EXPECT_THAT(failure,
              ContainsRegex("^(tool_contact: particle 2[0-4], edge [0-9]+ against tool 'top'|"
                            "edge_contact: particle [12][0-9], edge [0-9]+ against particle)"));
  EXPECT_THAT(failure,
              ContainsRegex("penetration [0-9.e-]+ m is 0\\.[5-9][0-9]* of the edge length"));
  EXPECT_THAT(failure, HasSubstr(step_now(e.simulation)));
  EXPECT_THAT(failure, HasSubstr("allowed 0.5 (limits.penetration)"));
}

// With the limit out of the way the elements give in: the failure is the element's, not a NaN later.
TEST(Health, ElementTurnedInsideOutIsNamed) {
  Experiment e(
      "compaction/regular-25.toml",
      {"stage.press.duration=70 us", "stage.press.move[0].displacement=[\"0 mm\", \"-21 mm\"]",
       "limits.penetration=1e6"},
      2);
  const std::string failure = failure_of(e.simulation, 10000);
  EXPECT_THAT(
      failure,
      ContainsRegex("^element_health: particle [0-9]+, element [0-9]+: det F = -?[0-9.e-]+"));
  EXPECT_THAT(failure, HasSubstr(step_now(e.simulation)));
}

// ---- not a number ---------------------------------------------------------------------------------
// Puts a NaN into node `node` of particle `number` and steps on.
template <class C>
std::string failure_with_nan(Experiment& e, int number, int node, std::int64_t max_steps) {
  World& world = e.simulation.world();
  const int slot = world.resource<Bodies>().slot_of_number[static_cast<std::size_t>(number)];
  Column<C>& column = world.column<C>();
  const auto first = column.table.chunk_begin[static_cast<std::size_t>(slot / lane_count)];
  column.lanes()[static_cast<std::size_t>(first + node) * C::count][slot % lane_count] =
      std::numeric_limits<double>::quiet_NaN();
  return failure_of(e.simulation, max_steps);
}

bool element_has_node(Experiment& e, const std::string& failure, int node) {
  std::smatch match;
  if (!std::regex_search(failure, match, std::regex("element ([0-9]+)"))) return false;
  const auto& quads = e.simulation.world().resource<Bodies>().shapes[0].quads;
  return std::ranges::count(quads.at(static_cast<std::size_t>(std::stoi(match[1]))),
                            Row<Node>(node)) > 0;
}

class NotANumber : public ::testing::TestWithParam<int> {};

TEST_P(NotANumber, InAPositionStopsTheRunInTheSameStep) {
  const int node = GetParam();
  Experiment e("compaction/regular-25.toml", {}, 2);
  e.simulation.run_steps(10);
  const std::int64_t step = e.simulation.clock().step;
  const std::string failure = failure_with_nan<Position<TwoD>>(e, 7, node, 1);
  EXPECT_THAT(failure, StartsWith("element_health: particle 7, element "));
  EXPECT_THAT(failure, ContainsRegex("det F = -?nan at step " + std::to_string(step) + ","));
  EXPECT_EQ(e.simulation.clock().step, step);
  EXPECT_TRUE(element_has_node(e, failure, node)) << failure;
}

// A velocity reaches the positions at the end of the step and the elements in the next one.
TEST_P(NotANumber, InAVelocityStopsTheRunOneStepLater) {
  Experiment e("compaction/regular-25.toml", {}, 2);
  e.simulation.run_steps(10);
  const std::int64_t step = e.simulation.clock().step;
  const std::string failure = failure_with_nan<Velocity<TwoD>>(e, 7, GetParam(), 2);
  EXPECT_THAT(failure, StartsWith("element_health: particle 7, element "));
  EXPECT_EQ(e.simulation.clock().step, step + 1);
}

// Amid touching outlines: the contact search meets the NaN before the elements do.
TEST_P(NotANumber, AmidContactIsFoundWithoutHarm) {
  Experiment e(
      "compaction/regular-25.toml",
      {"stage.press.duration=50 us", "stage.press.move[0].displacement=[\"0 mm\", \"-1.25 mm\"]"},
      2);
  e.simulation.run_steps(500);
  EXPECT_THAT(failure_with_nan<Velocity<TwoD>>(e, 17, GetParam(), 2), HasSubstr("particle 17"));
}

// The outline's nodes come first (40 of them); 150 lies inside.
INSTANTIATE_TEST_SUITE_P(Nodes, NotANumber, ::testing::Values(0, 5, 10, 15, 20, 25, 30, 35, 150));

TEST(Health, NotANumberInAnElasticSceneIsFoundToo) {
  Experiment e("basic/spinning-disc.toml");
  EXPECT_THAT(failure_with_nan<Position<TwoD>>(e, 0, 3, 1), HasSubstr("particle 0, element "));
}

// The energies are the second net: a sample with a NaN in it keeps no limit.
TEST(Health, NotANumberInTheEnergiesKeepsNoLimit) {
  Experiment e("compaction/regular-25.toml");
  e.simulation.run_steps(10);
  e.simulation.observe();
  e.results.sample();
  Column<ElasticEnergy>& energy = e.simulation.world().column<ElasticEnergy>();
  energy.values()[0] = std::numeric_limits<double>::quiet_NaN();
  e.results.sample();
  EXPECT_FALSE(e.results.energy_balance_error() <= 1);
}

// ---- through a wall -----------------------------------------------------------------------------------
// Puts particle `number` elsewhere, as an error of any kind would.
void shift(Experiment& e, int number, double x, double y) {
  World& world = e.simulation.world();
  const Bodies& bodies = world.resource<Bodies>();
  const int slot = bodies.slot_of_number[static_cast<std::size_t>(number)];
  Column<CurvePosition>& curve = world.column<CurvePosition>();
  const int first = bodies.slots[static_cast<std::size_t>(slot)].first_control;
  for (int i = first; i < first + bodies.shape_of_slot(slot).control_points(); ++i) {
    curve.values()[2 * i] += x;
    curve.values()[2 * i + 1] += y;
  }
}

TEST(Health, BodyLostThroughAWallIsNamed) {
  Experiment e("compaction/regular-25.toml", {"limits.penetration=1e6"}, 2);
  e.simulation.run_steps(10);
  shift(e, 12, 0.2, 0);  // 200 mm to the right: the die is 50 mm wide
  const std::string failure = message_of<RunFailure>([&] { e.simulation.observe(); });
  EXPECT_THAT(failure, StartsWith("lost_bodies: particle 12 has gone through tool 'right': "));
  EXPECT_THAT(failure, HasSubstr(step_now(e.simulation)));
  EXPECT_THAT(failure, ContainsRegex("is 0\\.17[0-9]* m behind it"));
}

TEST(Health, BodiesInTheirDieAreNotLost) {
  Experiment e("compaction/regular-25.toml", {}, 2);
  e.simulation.run_steps(10);
  EXPECT_NO_THROW(e.simulation.observe());
}

// ---- limits of the scene --------------------------------------------------------------------------
TEST(Health, PenetrationLimitNamesParticleAndTool) {
  Experiment e("compaction/unit-cell.toml", {"limits.penetration=0.01", "contact.stiffness=0.5"});
  const std::string failure = failure_of(e.simulation, 100000);
  EXPECT_THAT(failure,
              ContainsRegex("^tool_contact: particle 0, edge [0-9]+ against tool '[a-z]+': "));
  EXPECT_THAT(failure, HasSubstr("is 0.01 of the edge length at step "));
  EXPECT_THAT(failure, HasSubstr("allowed 0.01 (limits.penetration)"));
}

TEST(Health, PenetrationLimitNamesBothParticles) {
  Experiment e("basic/oblique-impact.toml", {"limits.penetration=0.001"});
  const std::string failure = failure_of(e.simulation, 100000);
  EXPECT_THAT(failure,
              ContainsRegex("^edge_contact: particle (0, edge [0-9]+ against particle 1|1, edge "
                            "[0-9]+ against particle 0): penetration [0-9.e-]+ m "));
  EXPECT_THAT(failure, HasSubstr(step_now(e.simulation)));
  EXPECT_THAT(failure, HasSubstr("limits.penetration"));
}

TEST(Health, LimitsThatAreKeptDoNotStopARun) {
  Experiment e("basic/oblique-impact.toml", {"stage.impact.duration=0.02 ms"});
  EXPECT_NO_THROW(e.simulation.run_until(e.simulation.clock().end));
}

// Energies are looked at when they are sampled: the program does it, with the recorder.
struct Ended {
  int status;
  nlohmann::json summary;
};
Ended run_of_program(const std::vector<std::string>& overrides) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::temp_directory_path() / ("pulvis-health-" + std::to_string(getpid()));
  std::string command = std::string("'") + paths::program() + "' run '" + paths::source_dir() +
                        "/scenes/compaction/regular-25.toml' -o '" + folder.string() +
                        "' --set output.frames=10 --set output.samples=50";
  for (const std::string& one : overrides) command += " --set '" + one + "'";
  const int status = std::system((command + " >/dev/null 2>&1").c_str());
  Ended ended{WEXITSTATUS(status), nlohmann::json::parse(std::ifstream(folder / "summary.json"))};
  fs::remove_all(folder);
  return ended;
}
std::vector<std::string> pressed(const char* duration, const char* by) {
  return {std::string("stage.press.duration=") + duration,
          std::string("stage.press.move[0].displacement=[\"0 mm\", \"-") + by + " mm\"]"};
}

nlohmann::json summary_of_a_bad_run(const std::string& limit) {
  std::vector<std::string> overrides = pressed("50 us", "1.25");
  overrides.push_back("limits." + limit);
  const Ended ended = run_of_program(overrides);
  EXPECT_EQ(ended.status, 3) << limit;
  return ended.summary;
}

// The figure that the message names.
double judged(const nlohmann::json& summary) {
  std::smatch match;
  const auto outcome = summary["outcome"].get<std::string>();
  if (!std::regex_search(outcome, match, std::regex(" is ([0-9.e+-]+) at step"))) return -1;
  return std::stod(match[1]);
}

TEST(Health, EnergyBalanceLimitStopsTheRun) {
  const auto summary = summary_of_a_bad_run("energy_balance=1e-7");
  EXPECT_THAT(summary["outcome"].get<std::string>(),
              ContainsRegex("^failed: energies: energy_balance is [0-9.e-]+ at step [0-9]+, t = "
                            "[0-9.e-]+ s; allowed 1e-07 \\(limits.energy_balance\\); most "
                            "distorted: particle [0-9]+, element [0-9]+, det F = .*$"));
  EXPECT_LT(summary["time"], 50e-6);
  const double reported = summary["energy_balance_error"];
  EXPECT_NEAR(judged(summary) / reported, 1, 1e-3);
}

TEST(Health, KineticEnergyLimitStopsTheRun) {
  const auto summary = summary_of_a_bad_run("kinetic_energy=1e-3");
  EXPECT_THAT(summary["outcome"].get<std::string>(),
              ContainsRegex("^failed: energies: kinetic_energy is .* \\(limits.kinetic_energy\\); "
                            "most distorted: particle [0-9]+, element .*$"));
  const double reported = summary["kinetic_ratio"];
  EXPECT_NEAR(judged(summary) / reported, 1, 1e-3);
}

// Meshes and times that resolve next to nothing: a run that is done keeps its limits by its own report, also
// where the punch gets to its particles in the last step.
TEST(Health, WhatIsDoneKeepsTheLimitsItReports) {
  for (const auto& [duration, by] :
       {std::pair("30 us", "5"), std::pair("30 us", "0.3"), std::pair("30 us", "0.31"),
        std::pair("1e-15 s", "1e-3"), std::pair("1e-15 s", "5"), std::pair("1e-9 s", "0.01")})
    for (const char* edges : {"4", "40"}) {
      std::vector<std::string> overrides = pressed(duration, by);
      overrides.push_back(std::string("particle.disc.mesh.boundary_edges=") + edges);
      const auto [status, summary] = run_of_program(overrides);
      const double error = summary["energy_balance_error"];
      EXPECT_EQ(status == 0, summary["outcome"] == "done");
      if (status == 0)
        EXPECT_LE(error, 0.05) << duration << ", " << by << " mm, " << edges;
      else
        EXPECT_EQ(status, 3);
    }
}

// What contact damping takes is its force times its way, of a force that sets in within a step half of that.
TEST(Health, DampingIsBookedFromTheFirstTouchOn) {
  const auto error = [](double safety) {
    Scene scene = read_scene(
        paths::source_dir() + "/scenes/extreme/impact-100-m-s.toml",
        {"contact.damping=1", "contact.friction=0", "time.safety=" + std::to_string(safety)});
    scene.materials[0].yield_stress.reset();
    scene.bodies[0].velocity /= 10;
    scene.stages[0].duration = 60e-6;
    Experiment e(std::move(scene));
    e.run(20);
    EXPECT_GT(e.value("energy/damping"), 0.05 * e.value("energy/kinetic"));
    return e.results.energy_balance_error();
  };
  const double coarse = error(0.8), fine = error(0.2);
  EXPECT_LT(coarse, 1.5e-3);  // 4e-3 with whole steps
  EXPECT_LT(fine, coarse / 3);
}

}  // namespace
}  // namespace pulvis
