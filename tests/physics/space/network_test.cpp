// The network of contacts in three dimensions: what it says adds up to what bodies and tools get, and lattices have the
// neighbours that geometry gives them.
#include <gtest/gtest.h>

#include <cstring>
#include <numbers>

#include "components/body.hpp"
#include "components/observed.hpp"
#include "components/space/shape.hpp"
#include "scenes/results/state_hash.hpp"
#include "scenes/spec/scene.hpp"
#include "systems/observe/network_kernel.hpp"
#include "tests/helpers/experiment.hpp"

namespace pulvis::space {
namespace {

std::string folder_of_scenes() { return paths::source_dir() + "/scenes/compaction-3d/"; }

Scene network_scene(const char* file, std::vector<std::string> more) {
  more.insert(more.end(), {"particle.ball.mesh.divisions=2", "particle.ball.mesh.rings=2",
                           "output.contacts=true"});
  return read_scene(folder_of_scenes() + file, more);
}
// Eight balls and their neighbours between six planes, with friction and plastic flow.
Scene body_centred(std::vector<std::string> more = {}) {
  more.insert(more.end(), {"stage.press.duration=0.02 ms", "let.move=0.3 mm"});
  return network_scene("unit-cell-bcc.toml", std::move(more));
}

const ContactNetwork<ThreeD>& network_in(Experiment& e) {
  return e.simulation.world().resource<ContactNetwork<ThreeD>>();
}
Vec3 vector_of(const Point& p) { return {p[0], p[1], p[2]}; }

std::vector<Vec3> forces_by_particle(Experiment& e) {
  std::vector<Vec3> sums(
      static_cast<std::size_t>(e.simulation.world().resource<Bodies>().particles()), Vec3::Zero());
  for (const ContactLink<ThreeD>& l : network_in(e).pairs) {
    sums[static_cast<std::size_t>(l.first)] += vector_of(l.force);
    sums[static_cast<std::size_t>(l.second)] -= vector_of(l.force);
  }
  for (const ContactLink<ThreeD>& l : network_in(e).tools)
    sums[static_cast<std::size_t>(l.first)] += vector_of(l.force);
  return sums;
}

// Sum of the forces on the nodes of a particle, as contact_force left them.
Vec3 contact_force_on(Experiment& e, int slot) {
  const World& world = e.simulation.world();
  const auto& column = e.column<ContactForce<ThreeD>>();
  const int lane = slot % lane_count,
            shape = world.resource<Bodies>().slots[static_cast<std::size_t>(slot)].shape;
  const auto first = static_cast<std::size_t>(
      column.table.chunk_begin[static_cast<std::size_t>(slot / lane_count)]);
  const auto nodes = static_cast<std::size_t>(
      world.resource<Shapes>().list[static_cast<std::size_t>(shape)].boundary_nodes);
  Vec3 sum = Vec3::Zero();
  for (std::size_t n = first; n < first + nodes; ++n)
    for (std::size_t k = 0; k < 3; ++k)
      sum[static_cast<Eigen::Index>(k)] += column.lanes()[3 * n + k][lane];
  return sum;
}

// Action and reaction: nothing of any row is lost or counted twice.
TEST(NetworkInSpace, GivesEveryParticleAndToolItsForce) {
  Experiment e(body_centred({"contact.friction=0.3"}));
  e.run(3);
  const std::vector<Vec3> sums = forces_by_particle(e);
  const double largest = e.value("network/largest_force");
  ASSERT_GT(largest, 1);
  const std::vector<int>& slots = e.simulation.world().resource<Bodies>().slot_of_number;
  for (std::size_t p = 0; p < sums.size(); ++p)
    EXPECT_LT((sums[p] - contact_force_on(e, slots[p])).norm(), 1e-11 * largest) << p;
  const auto& tools = e.scene.tools;
  std::vector<Vec3> on_tools(tools.size(), Vec3::Zero());
  for (const ContactLink<ThreeD>& l : network_in(e).tools)
    on_tools[static_cast<std::size_t>(l.second)] -= vector_of(l.force);
  for (std::size_t t = 0; t < tools.size(); ++t)
    for (const auto& [k, axis] : {std::pair{0, "x"}, {1, "y"}, {2, "z"}})
      EXPECT_NEAR(on_tools[t][k], e.value("tool/" + tools[t].name + "/force_" + axis),
                  1e-11 * largest)
          << tools[t].name << axis;
}

// Held, with damping enough for it to come to rest: the forces on each particle cancel.
TEST(NetworkInSpace, IsInEquilibriumAtRest) {
  Scene scene = body_centred({"contact.damping=0.5", "contact.friction=0.3",
                              "material.316L.damping.stiffness_proportional=40 ns"});
  scene.stages.front().duration = 0.4e-3;
  scene.stages.emplace_back().duration = 0.6e-3;
  Experiment e(std::move(scene));
  e.run(2);
  const double mean = e.value("network/mean_force");
  ASSERT_GT(mean, 1);
  for (const Vec3& sum : forces_by_particle(e)) EXPECT_LT(sum.norm(), 0.01 * mean);
}

// Body-centred: the ball in the middle touches eight, along the diagonals, so that the fabric has no direction.
TEST(NetworkInSpace, OfABodyCentredLatticeHasEightNeighboursAlongTheDiagonals) {
  Experiment e(body_centred({"contact.friction=0"}));
  e.run(2);
  std::vector<double> pairs(forces_by_particle(e).size());
  pulvis::kernels::count_contacts(network_in(e).pairs, true, pairs);
  EXPECT_EQ(*std::max_element(pairs.begin(), pairs.end()), 8);
  for (const ContactLink<ThreeD>& l : network_in(e).pairs) {
    for (const double part : l.normal) EXPECT_NEAR(std::abs(part), std::sqrt(1 / 3.0), 0.02);
    EXPECT_LT(l.tangential_force(), 0.05 * l.normal_force());
  }
  for (const char* part : {"xx", "yy", "zz"})
    EXPECT_NEAR(e.value(std::string("network/fabric_") + part), 1 / 3.0, 0.01);
  EXPECT_LT(e.value("network/anisotropy"), 0.02);
}

// Hertz: an elastic ball under a force F touches a circle of radius (3 F R / 4 E')^(1/3), here as wide as a face. A point of
// a face touches or does not, and contacts of a soft penalty are a little wider: a third of the area is what can be told.
TEST(NetworkInSpace, KnowsTheAreaOfHertzContact) {
  Experiment e(read_scene(folder_of_scenes() + "one-sphere.toml",
                          {"output.contacts=true", "contact.stiffness=5",
                           "particle.ball.mesh.divisions=6", "particle.ball.mesh.rings=2",
                           "material[0].yield_stress=190 GPa", "stage.press.duration=0.2 ms",
                           "stage.press.move.top.displacement=[\"0 mm\", \"0 mm\", \"-1 mm\"]"}));
  e.simulation.run_until(0.2e-3);
  e.simulation.observe();
  ASSERT_EQ(network_in(e).tools.size(), 2U);
  const double modulus = 200e9 / (1 - 0.3 * 0.3), radius = 5e-3;
  for (const ContactLink<ThreeD>& link : network_in(e).tools) {
    const double touching = std::cbrt(0.75 * link.normal_force() * radius / modulus);
    EXPECT_NEAR(std::abs(link.normal[2]), 1, 1e-12);
    EXPECT_NEAR(link.size / (std::numbers::pi * touching * touching), 1, 0.35);
  }
}

TEST(NetworkInSpace, HasTheSameBitsForAnyNumberOfThreadsAndLeavesTheRunAlone) {
  const auto state = [](const char* contacts, int threads) {
    auto e = std::make_unique<Experiment>(
        body_centred({"contact.friction=0.2", std::string("output.contacts=") + contacts}),
        threads);
    e->run(4);
    return e;
  };
  const auto one = state("true", 1), two = state("true", 2), without = state("false", 1);
  ASSERT_EQ(one->row.size(), two->row.size());  // some of their numbers are not a number
  EXPECT_EQ(std::memcmp(one->row.data(), two->row.data(), sizeof(double) * one->row.size()), 0);
  EXPECT_EQ(one->results.frame(), two->results.frame());
  EXPECT_EQ(state_hash(one->simulation.world()), state_hash(without->simulation.world()));
}

}  // namespace
}  // namespace pulvis::space
