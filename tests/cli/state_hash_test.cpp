// The hash of the final state: blind to threads and storage, and to nothing else.
#include "scenes/results/state_hash.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>

#include "scenes/packing/place.hpp"
#include "tests/helpers/experiment.hpp"
#include "tests/helpers/last_bit.hpp"
#include "tests/helpers/paths.hpp"

namespace pulvis {
namespace {

// The punch at 25 m/s on average: the upper rows touch, slide and flow plastically.
Scene fast_scene() {
  return read_scene(
      paths::source_dir() + "/scenes/compaction/regular-25.toml",
      {"stage.press.duration=50 us", "stage.press.move[0].displacement=[\"0 mm\", \"-1.25 mm\"]"});
}

std::uint64_t hash_after(const Scene& scene, int threads, int steps) {
  Simulation simulation(scene, threads);
  simulation.run_steps(steps);
  return state_hash(simulation.world());
}

TEST(StateHash, IsThatOfOneThreadForTwoAndThree) {
  const std::uint64_t one = hash_after(fast_scene(), 1, 400);
  EXPECT_EQ(one, hash_after(fast_scene(), 2, 400));
  EXPECT_EQ(one, hash_after(fast_scene(), 3, 400));
  EXPECT_NE(one, hash_after(fast_scene(), 1, 401));
}

// The same discs as two classes that take turns: other lanes, other chunks, other order of contact rows.
Scene in_two_classes(Scene scene) {
  scene.bodies = place_bodies(scene);
  scene.packings.clear();
  scene.particles.push_back(scene.particles.front());
  for (std::size_t i = 0; i < scene.bodies.size(); ++i)
    scene.bodies[i].particle = static_cast<int>(i % 2);
  return scene;
}

TEST(StateHash, DoesNotSeeLanesAndChunks) {
  const Scene one = fast_scene(), two = in_two_classes(one);
  Simulation a(one), b(two);
  ASSERT_NE(a.world().resource<Bodies>().slot_of_number,
            b.world().resource<Bodies>().slot_of_number);
  a.run_steps(400);
  b.run_steps(400);
  ASSERT_GT(a.world().resource<Totals>().touching, 50);
  EXPECT_EQ(state_hash(a.world()), state_hash(b.world()));
}

// ---- what it sees -------------------------------------------------------------------------------
class StateHashOf : public ::testing::Test {
 protected:
  StateHashOf() : simulation(fast_scene()) { simulation.run_steps(400); }
  World& world() { return simulation.world(); }

  bool sees(double& value) { return last_bit_counts(world(), value); }
  // Of the first and the last number of a particle in a laned column.
  template <class C>
  std::array<bool, 2> sees_ends(int slot) {
    Column<C>& column = world().column<C>();
    const auto chunk = static_cast<std::size_t>(slot / lane_count);
    const auto& begin = column.table.chunk_begin;
    const auto at = [&](int row, int component) -> double& {
      return column.values()[(row * C::count + component) * lane_count + slot % lane_count];
    };
    return {sees(at(begin[chunk], 0)), sees(at(begin[chunk + 1] - 1, C::count - 1))};
  }
  template <class At>
  double& slip(bool touches) {
    const auto& column = world().column<ContactTouches<At>>();
    for (std::size_t r = 0; r < column.table.rows; ++r)
      if ((column.values()[r] != 0) == touches)
        return world().column<ElasticSlip<At>>().values()[edge_points * r + 3];
    throw std::logic_error("no such row");
  }

  static constexpr std::array<bool, 2> both{true, true}, neither{false, false};
  Simulation simulation;
};

TEST_F(StateHashOf, SeesEveryBitOfWhatTheNextStepStartsFrom) {
  for (const int number : {0, 24}) {
    const int slot = world().resource<Bodies>().slot_of_number[static_cast<std::size_t>(number)];
    EXPECT_EQ(sees_ends<Position<TwoD>>(slot), both);
    EXPECT_EQ(sees_ends<Velocity<TwoD>>(slot), both);
    EXPECT_EQ((sees_ends<CpInverse<TwoD, 1>>(slot)), both);
    EXPECT_EQ(sees_ends<PlasticStrain<1>>(slot), both);
    EXPECT_EQ(sees_ends<PlasticHourglass<TwoD>>(slot), both);
  }
  EXPECT_TRUE(sees(slip<Contact>(true)));
  EXPECT_TRUE(sees(slip<ToolContact>(true)));
  EXPECT_TRUE(sees(world().resource<Clock>().time));
  EXPECT_TRUE(sees(world().resource<Clock>().dt_before));
}

TEST_F(StateHashOf, DoesNotSeeWhatIsMadeAnewNorEmptyLanes) {
  const Bodies& bodies = world().resource<Bodies>();
  EXPECT_EQ(sees_ends<InternalForce<TwoD>>(bodies.slot_of_number[0]), neither);
  EXPECT_EQ((sees_ends<DeviatoricStress<TwoD, 1>>(bodies.slot_of_number[0])), neither);
  EXPECT_FALSE(sees(slip<Contact>(false)));
  const int last = static_cast<int>(bodies.slots.size()) - 1;
  ASSERT_EQ(bodies.slots.back().number, Bodies::empty_slot);
  EXPECT_EQ(sees_ends<Position<TwoD>>(last), neither);
}

TEST(StateHash, SeesThePlasticStateOfFourPointElements) {
  Scene scene = fast_scene();
  scene.element.formulation = Formulation::four_point;
  Simulation simulation(scene);
  const std::uint64_t before = state_hash(simulation.world());
  simulation.world().column<PlasticStrain<4>>().values()[0] = 1e-9;
  const std::uint64_t with_strain = state_hash(simulation.world());
  simulation.world().column<CpInverse<TwoD, 4>>().values()[0] = 1e-9;
  EXPECT_NE(before, with_strain);
  EXPECT_NE(with_strain, state_hash(simulation.world()));
}

}  // namespace
}  // namespace pulvis
