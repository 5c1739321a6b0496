// The network of contacts: what it says adds up to what the bodies and tools get, and regular packings have
// the neighbours that geometry gives them.
#include "systems/observe/network_kernel.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "scenes/results/state_hash.hpp"
#include "tests/helpers/experiment.hpp"
#include "tests/helpers/paths.hpp"

namespace pulvis {
namespace {

const std::vector<std::string> pressed{"stage.press.duration=0.7 ms", "output.contacts=true"};

std::vector<std::string> with(std::vector<std::string> all, const std::vector<std::string>& more) {
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

const ContactNetwork<TwoD>& network_of(Experiment& e) {
  return e.simulation.world().resource<ContactNetwork<TwoD>>();
}
const Bodies& bodies_of(Experiment& e) { return e.simulation.world().resource<Bodies>(); }

// Sum of the forces on the nodes of a particle, as contact_force left them.
Vec2 force_on_nodes(Experiment& e, int slot) {
  const auto& column = e.column<ContactForce<TwoD>>();
  const auto first = static_cast<std::size_t>(
      column.table.chunk_begin[static_cast<std::size_t>(slot / lane_count)]);
  Vec2 sum = Vec2::Zero();
  for (std::size_t n = 0;
       n < static_cast<std::size_t>(bodies_of(e).shape_of_slot(slot).boundary_nodes); ++n)
    for (std::size_t k = 0; k < 2; ++k)
      sum[static_cast<Eigen::Index>(k)] += column.lanes()[2 * (first + n) + k][slot % lane_count];
  return sum;
}

std::vector<Vec2> sums_by_particle(Experiment& e) {
  std::vector<Vec2> sums(static_cast<std::size_t>(bodies_of(e).particles()), Vec2::Zero());
  for (const ContactLink<TwoD>& l : network_of(e).pairs) {
    sums[static_cast<std::size_t>(l.first)] += Vec2(l.force[0], l.force[1]);
    sums[static_cast<std::size_t>(l.second)] -= Vec2(l.force[0], l.force[1]);
  }
  for (const ContactLink<TwoD>& l : network_of(e).tools)
    sums[static_cast<std::size_t>(l.first)] += Vec2(l.force[0], l.force[1]);
  return sums;
}

// With friction and plastic flow: action and reaction, and nothing of any row is lost or counted twice.
TEST(ContactNetwork, GivesEveryParticleAndToolItsForce) {
  Experiment e("compaction/regular-25.toml", pressed);
  e.run(3);
  const std::vector<Vec2> sums = sums_by_particle(e);
  const double maximum = e.value("network/largest_force");
  ASSERT_GT(maximum, 1000);
  for (std::size_t p = 0; p < sums.size(); ++p)
    EXPECT_LT((sums[p] - force_on_nodes(e, bodies_of(e).slot_of_number[p])).norm(),
              1e-11 * maximum);
  std::vector<Vec2> on_tools(e.scene.tools.size(), Vec2::Zero());
  for (const ContactLink<TwoD>& l : network_of(e).tools)
    on_tools[static_cast<std::size_t>(l.second)] -= Vec2(l.force[0], l.force[1]);
  for (std::size_t t = 0; t < on_tools.size(); ++t) {
    const std::string name = "tool/" + e.scene.tools[t].name + "/force_";
    EXPECT_NEAR(on_tools[t].x(), e.value(name + "x"), 1e-11 * maximum) << name;
    EXPECT_NEAR(on_tools[t].y(), e.value(name + "y"), 1e-11 * maximum) << name;
  }
}

Vec2 momentum_of(Experiment& e, int slot) {
  const auto& column = e.column<Velocity<TwoD>>();
  const Shape& shape = bodies_of(e).shape_of_slot(slot);
  const auto first = static_cast<std::size_t>(
      column.table.chunk_begin[static_cast<std::size_t>(slot / lane_count)]);
  Vec2 sum = Vec2::Zero();
  for (std::size_t n = 0; n < shape.nodes.size(); ++n) {
    const Lane* v = column.lanes() + 2 * (first + n);
    sum += shape.nodal_area[n] * Vec2(v[0][slot % lane_count], v[1][slot % lane_count]);
  }
  return sum * e.scene.materials[0].density * e.scene.thickness;
}

// Newton's second law, while all is in motion: stresses move nothing, so that the contacts alone change the
// momentum of a particle.
TEST(ContactNetwork, ChangesTheMomentumOfEveryParticle) {
  Experiment e("compaction/regular-25.toml", pressed);
  e.simulation.run_until(0.3e-3);
  e.simulation.observe();
  e.results.sample();
  std::vector<Vec2> before;
  for (const int slot : bodies_of(e).slot_of_number) before.push_back(momentum_of(e, slot));
  const Clock& clock = e.simulation.clock();
  const double dt = 0.5 * (clock.dt_before + clock.dt);
  const std::vector<Vec2> sums = sums_by_particle(e);
  e.simulation.move();
  double largest = 0;
  for (std::size_t p = 0; p < before.size(); ++p) {
    const Vec2 change = momentum_of(e, bodies_of(e).slot_of_number[p]) - before[p];
    largest = std::max(largest, change.norm());
    EXPECT_LT((change - dt * sums[p]).norm(), 1e-9 * dt * e.value("network/largest_force")) << p;
  }
  EXPECT_GT(largest, 1e-4 * dt * e.value("network/largest_force"));
}

// Held, with damping enough for it to come to rest: the forces on each particle cancel.
TEST(ContactNetwork, IsInEquilibriumAtRest) {
  Scene scene = read_scene(paths::source_dir() + "/scenes/compaction/regular-25.toml",
                           with(pressed, {"contact.damping=0.5"}));
  scene.stages.emplace_back().duration = 2e-3;
  Experiment e(std::move(scene));
  e.run(2);
  const double mean = e.value("network/mean_force");
  ASSERT_GT(mean, 1000);
  for (const Vec2& sum : sums_by_particle(e)) EXPECT_LT(sum.norm(), 0.01 * mean);
}

TEST(ContactNetwork, OfASquareMatrixHasFourNeighboursInTwoDirections) {
  Experiment e("compaction/regular-25.toml", with(pressed, {"contact.friction=0"}));
  e.run(3);
  std::vector<double> pairs(25), tools(25);
  kernels::count_contacts(network_of(e).pairs, true, pairs);
  kernels::count_contacts(network_of(e).tools, false, tools);
  for (std::size_t p = 0; p < 25; ++p) EXPECT_EQ(pairs[p] + tools[p], 4) << p;
  EXPECT_DOUBLE_EQ(e.value("network/coordination"), 2 * 40.0 / 25);
  EXPECT_DOUBLE_EQ(e.value("network/tools"), 20.0 / 25);
  EXPECT_EQ(e.value("network/rattlers"), 0);
  const kernels::Rose rose = kernels::rose(network_of(e).pairs);
  EXPECT_NEAR(rose.number[0], 0.5, 1e-12);
  EXPECT_NEAR(rose.number[9], 0.5, 1e-12);
  EXPECT_NEAR(e.value("network/fabric_xx"), 0.5, 1e-3);
  EXPECT_NEAR(e.value("network/fabric_xy"), 0, 1e-3);
}

// The right wall comes in, too, that the neighbours beside stay in touch.
TEST(ContactNetwork, OfAHexagonalPackingHasSixNeighboursInThreeDirections) {
  Scene scene = read_scene(
      paths::source_dir() + "/scenes/compaction/hexagonal-1683.toml",
      {"packing[0].rows=7", "packing[0].columns=6", "tool.right.point=[\"60 mm\", \"0 mm\"]",
       "tool.top.point=[\"0 mm\", \"61.961524228 mm\"]", "stage.press.duration=0.8 ms",
       "stage.press.move[0].displacement=[\"0 mm\", \"-1 mm\"]", "contact.friction=0",
       "output.contacts=true"});
  for (std::size_t t = 0; t < scene.tools.size(); ++t)
    if (scene.tools[t].name == "right")
      scene.stages[0].moves.push_back({static_cast<int>(t), Vec3(-1e-3, 0, 0), 0.1, {}, {}, 0, {}});
  Experiment e(std::move(scene));
  e.run(2);
  std::vector<double> pairs(static_cast<std::size_t>(bodies_of(e).particles()));
  std::vector<double> tools(pairs.size());
  kernels::count_contacts(network_of(e).pairs, true, pairs);
  kernels::count_contacts(network_of(e).tools, false, tools);
  // Rows of 6 and 5 in turn. Those of 6 fill the die: in the third and fifth all but the outer ones have two
  // neighbours beside, two below and two above. Rows of 5 have room at the walls and may spread.
  for (const std::size_t first : {11U, 22U})
    for (std::size_t p = first + 1; p < first + 5; ++p) EXPECT_EQ(pairs[p], 6) << p;
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    EXPECT_LE(pairs[p] + tools[p], 6) << p;
    EXPECT_GE(pairs[p] + tools[p], 2) << p;
  }
  const kernels::Rose rose = kernels::rose(network_of(e).pairs);
  EXPECT_NEAR(rose.number[0] + rose.number[6] + rose.number[12], 1, 1e-12);
  EXPECT_NEAR(rose.number[6], rose.number[12], 1e-12);
}

// Where Hertz' line contact is as wide as 2 a = 2 sqrt(4 P R / (pi E*)). Points of the outline touch or do
// not: a fifth of an edge at either end is what can be told.
TEST(ContactNetwork, KnowsTheWidthOfHertzContact) {
  Experiment e("basic/disc-platens.toml", {"output.contacts=true"});
  e.run(2);
  ASSERT_EQ(network_of(e).tools.size(), 2U);
  const MaterialSpec& m = e.scene.materials[0];
  const double modulus = m.youngs_modulus / (1 - m.poissons_ratio * m.poissons_ratio);
  for (const ContactLink<TwoD>& link : network_of(e).tools) {
    const double load = link.normal_force() / e.scene.thickness;
    const double width = 2 * std::sqrt(4 * load * 5e-3 / (std::numbers::pi * modulus));
    EXPECT_NEAR(link.size / width, 1, 0.15);
    EXPECT_NEAR(link.point[0], 0, 1e-9);
    EXPECT_NEAR(std::abs(link.normal[1]), 1, 1e-12);
    EXPECT_NEAR(link.tangential_force() / link.normal_force(), 0, 1e-6);
  }
}

// Two blocks glued on top of each other, pulled apart: tension, with the normal still into the lower one.
TEST(ContactNetwork, TellsTensionFromCompression) {
  Experiment e("bonds/pulled-blocks.toml", {"output.contacts=true"});
  double most = 0;
  e.run(40, [&] {
    EXPECT_GE(e.value("contact_overlap"), 0);
    for (const ContactLink<TwoD>& link : network_of(e).pairs) {
      most = std::max(most, -link.normal_force());
      EXPECT_EQ(link.first, 0);
      EXPECT_NEAR(link.normal[1], -1, 1e-6);
      EXPECT_EQ(link.force[1] > 0, link.normal_force() < 0);
    }
  });
  EXPECT_GT(most, 5);
}

TEST(ContactNetwork, HasTheSameBitsForAnyNumberOfThreadsAndLeavesTheRunAlone) {
  const auto state = [](const std::vector<std::string>& overrides, int threads) {
    auto e = std::make_unique<Experiment>("compaction/regular-25.toml", overrides, threads);
    e->simulation.run_steps(300);
    e->simulation.observe();
    e->results.sample();
    e->simulation.move();
    e->simulation.run_steps(50);
    e->simulation.observe();
    return e;
  };
  const auto all = with(pressed, {"output.density_cells=[5, 5]"});
  const auto one = state(all, 1), three = state(all, 3), without = state({pressed[0]}, 1);
  EXPECT_EQ(one->results.sample(), three->results.sample());
  EXPECT_EQ(one->results.frame(), three->results.frame());
  EXPECT_EQ(state_hash(one->simulation.world()), state_hash(without->simulation.world()));
}

}  // namespace
}  // namespace pulvis
