// The hash of a lever's final state: blind to threads, and to nothing that the next increment starts from.
#include "scenes/results/state_hash.hpp"

#include <algorithm>
#include <cstdint>
#include <span>

#include "components/probe.hpp"
#include "components/solid.hpp"
#include "systems/lever/solid_equations.hpp"
#include "tests/helpers/afm_run.hpp"
#include "tests/helpers/last_bit.hpp"

namespace pulvis {
namespace {

// The lever yields at its clamp, the probe slides over an incline.
const std::vector<std::string> soft{"material.lever.yield_stress=0.4 MPa",
                                    "material.lever.hardening_modulus=100 GPa"};

Scene loop(double friction = 0.1, const std::vector<std::string>& overrides = {}) {
  return afm_scene(std::string(coarse_beam) + inclined_plane(14, friction) + press_and_scan(4),
                   overrides);
}

std::uint64_t hash_after(const Scene& scene, int threads = 1) {
  AfmSimulation simulation(scene, threads);
  history_of(simulation);
  return state_hash(simulation.world());
}

TEST(SolidStateHash, IsThatOfOneThreadForTwoAndThree) {
  for (const auto& overrides : {std::vector<std::string>{}, soft}) {
    const Scene scene = loop(0.1, overrides);
    const std::uint64_t one = hash_after(scene);
    EXPECT_EQ(hash_after(scene, 2), one);
    EXPECT_EQ(hash_after(scene, 3), one);
  }
}

TEST(SolidStateHash, SeesFrictionAndScan) {
  const std::uint64_t plain = hash_after(loop());
  EXPECT_NE(hash_after(loop(0.11)), plain);
  EXPECT_NE(hash_after(loop(0.1, {"action[1].distance=4.1 nm"})), plain);
  EXPECT_NE(hash_after(loop(0.1, {"action[1].increments=5"})), plain);
}

class SolidStateHashOf : public ::testing::Test {
 protected:
  SolidStateHashOf() : scene(loop(0.1, soft)), simulation(scene) { history_of(simulation); }
  World& world() { return simulation.world(); }

  bool sees(double& value) { return last_bit_counts(world(), value); }
  template <class C>
  bool sees_ends() {
    Column<C>& column = world().column<C>();
    double* last = column.values() + column.bytes() / sizeof(double) - 1;
    return sees(*column.values()) && sees(*last);
  }

  bool flowed() {
    const auto& memory = world().column<SolidMemory>();
    const std::span values(memory.values(), memory.bytes() / sizeof(double));
    return std::ranges::any_of(values, [](double value) { return value != 0; });
  }

  const Scene scene;
  AfmSimulation simulation;
};

TEST_F(SolidStateHashOf, SeesEveryBitOfWhatTheNextIncrementStartsFrom) {
  EXPECT_TRUE(sees_ends<Displacement>());
  EXPECT_TRUE(sees_ends<AppliedForce>());
  EXPECT_TRUE(sees_ends<ProbeForce>());
  EXPECT_TRUE(sees_ends<ProbeMemory>());
  EXPECT_TRUE(sees_ends<SolidMemory>());
  EXPECT_TRUE(sees(world().resource<Target>().travel[1]));
  EXPECT_TRUE(sees(world().resource<Target>().set_point));
  // Of the factors, which may serve the next increment again.
  EXPECT_TRUE(sees(world().resource<SolidEquations>().plain.stiffness.front()));
  EXPECT_TRUE(flowed());
}

TEST_F(SolidStateHashOf, DoesNotSeeWhatAnIncrementMakesAnew) {
  EXPECT_FALSE(sees_ends<ElementEnergy>());
  EXPECT_FALSE(sees_ends<ElementForce>());
  EXPECT_FALSE(sees_ends<BlockTangent>());
  EXPECT_FALSE(sees_ends<ProbeState>());
}

}  // namespace
}  // namespace pulvis
