// The order of particles in memory: Hilbert's curve, and that runs follow it.
#include "scenes/hilbert.hpp"

#include <gtest/gtest.h>

#include <map>
#include <random>

#include "tests/helpers/experiment.hpp"
#include "tests/helpers/paths.hpp"

namespace pulvis {
namespace {

TEST(Hilbert, GoesThroughEveryCellOnceAndFromNeighbourToNeighbour) {
  for (const int order : {1, 2, 3, 6}) {
    const std::uint32_t side = 1U << order;
    std::map<std::uint64_t, std::pair<int, int>> cells;
    for (std::uint32_t x = 0; x < side; ++x)
      for (std::uint32_t y = 0; y < side; ++y)
        cells[hilbert_number(order, x, y)] = {static_cast<int>(x), static_cast<int>(y)};
    ASSERT_EQ(cells.size(), std::size_t{side} * side);
    EXPECT_EQ(cells.rbegin()->first, std::uint64_t{side} * side - 1);
    for (auto next = std::next(cells.begin()); next != cells.end(); ++next) {
      const auto [x, y] = std::prev(next)->second;
      EXPECT_EQ(std::abs(next->second.first - x) + std::abs(next->second.second - y), 1);
    }
  }
}

// 256 discs in random order: those that touch stand near each other in memory all the same.
TEST(MemoryOrder, NeighboursAreNearWhateverTheOrderOfTheScene) {
  Scene scene = read_scene(
      paths::source_dir() + "/scenes/compaction/regular-100.toml",
      {"packing[0].rows=16", "packing[0].columns=16", "tool.right.point=[\"160 mm\", \"0 mm\"]",
       "tool.top.point=[\"0 mm\", \"160 mm\"]"});
  const PackingSpec packing = scene.packings[0];
  scene.packings.clear();
  for (int i = 0; i < 256; ++i) {
    BodySpec body;
    body.position = packing.spacing * Vec3(i % 16 + 0.5, i / 16 + 0.5, 0);
    scene.bodies.push_back(body);
  }
  std::mt19937_64 random(1);
  std::ranges::shuffle(scene.bodies, random);
  Simulation simulation(scene);
  simulation.run_steps(1);
  const World& world = simulation.world();
  const auto& bodies = world.resource<Bodies>();
  for (std::size_t i = 0; i < scene.bodies.size(); ++i)
    EXPECT_EQ(bodies.slots[static_cast<std::size_t>(bodies.slot_of_number[i])].number,
              static_cast<int>(i));
  const auto& pair = world.column<ContactPair<Contact>>();
  double apart = 0;
  for (std::size_t r = 0; r < pair.table.rows; ++r)
    apart += std::abs(pair.values()[3 * r] - pair.values()[3 * r + 2]);
  // Row by row it would be 8.5 on average, at random 85.
  EXPECT_LT(apart / static_cast<double>(pair.table.rows), 16);
  EXPECT_GT(pair.table.rows, 1000U);
}

}  // namespace
}  // namespace pulvis
