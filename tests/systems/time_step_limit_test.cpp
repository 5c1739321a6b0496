// What is said to set the time step, against the steps of worlds without that particle, without contact, or with other springs.
#include "systems/time_step_limit.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "components/highest_mode.hpp"
#include "components/run_state.hpp"
#include "scenes/simulation.hpp"

namespace pulvis {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

// Three particles, 10 m apart, in two or three dimensions; the second one can be changed.
struct ThreeParticles {
  explicit ThreeParticles(int axes) {
    scene.dimension = axes;
    scene.materials = {{"elastic", 1000, 1e6, 0.3, {}, 0, {}, {}}};
    scene.particles = {{"coarse", 0, DiscOutline{1}, DiscMesh{24, 2, 1}, false, 0, {}}};
    scene.particles[0].shape = SphereShape{1};
    scene.particles[0].hex_mesh = {.divisions = 2, .rings = 2};
    scene.particles.push_back(scene.particles[0]);
    scene.particles[1].name = "fine";
    for (int i = 0; i < 3; ++i) {
      BodySpec& body = scene.bodies.emplace_back();
      body.particle = i == 1;
      body.position = Vec3(10 * i, 0, 0);
    }
    scene.stages.emplace_back().duration = 1;
  }
  ParticleSpec& changed() { return scene.particles[1]; }
  TimeStepLimit limit() const {
    Simulation simulation(scene);
    return time_step_limit(simulation.world());
  }
  // Without contact: of a particle of that class alone.
  double step_alone(int particle) const {
    ThreeParticles one(*this);
    one.scene.bodies = {scene.bodies[0]};
    one.scene.bodies[0].particle = particle;
    return one.limit().stable;
  }
  Scene scene;
};

class TimeStepLimits : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Dimension, TimeStepLimits, testing::Values(2, 3));

double distance_from(const BodySpec& body, const TimeStepLimit& limit) {
  return (Vec3(limit.at[0], limit.at[1], limit.at[2]) - body.position).norm();
}

TEST_P(TimeStepLimits, NameTheParticleWithTheFinerMesh) {
  ThreeParticles three(GetParam());
  three.scene.contact.stiffness = 1e-6;  // contact adds nothing
  three.changed().mesh = DiscMesh{60, 3, 1};
  three.changed().hex_mesh = {.divisions = 4, .rings = 4};
  const TimeStepLimit limit = three.limit();
  EXPECT_EQ(limit.particle, 1);
  EXPECT_EQ(limit.particle_class, "fine");
  EXPECT_NEAR(limit.stable / three.step_alone(1), 1, 1e-5);
  EXPECT_LT(limit.stable, 0.8 * three.step_alone(0));
  EXPECT_EQ(limit.shortened, "");
  EXPECT_EQ(limit.dt, 0.9 * limit.stable);
  EXPECT_FALSE(limit.by_contact());
  EXPECT_LT(distance_from(three.scene.bodies[1], limit), 0.5);
}

// Steps are proportional to size: what the small particle costs is known.
TEST_P(TimeStepLimits, TellWhatTheSlowestElementsCost) {
  ThreeParticles three(GetParam());
  const TimeStepLimit equal = three.limit();
  three.changed().outline = DiscOutline{0.5};
  three.changed().shape = SphereShape{0.5};
  const TimeStepLimit limit = three.limit();
  EXPECT_EQ(limit.particle, 1);
  EXPECT_NEAR(limit.stable / equal.stable, 0.5, 1e-9);
  EXPECT_GT(limit.median, 1.2 * equal.median);  // two thirds of the elements have twice the step
  EXPECT_LE(limit.median, 2 * equal.median);
  EXPECT_GE(limit.past_slowest, 1);
  EXPECT_LE(limit.past_slowest, limit.median);
}

// Springs add to the squared frequency of the element.
TEST_P(TimeStepLimits, NameContactWhereItsSpringsAreStiff) {
  ThreeParticles three(GetParam());
  three.scene.contact.stiffness = 100;
  const TimeStepLimit limit = three.limit();
  EXPECT_TRUE(limit.by_contact());
  EXPECT_FALSE(limit.by_mode);
  EXPECT_THAT(limit.place, HasSubstr(GetParam() == 2 ? "on the outline" : "on the surface"));
  EXPECT_NEAR(limit.without_contact * limit.stable / three.step_alone(0), 1, 1e-12);
  three.scene.contact.stiffness = 100 * 1.001;
  const double change = std::log(three.limit().stable / limit.stable) / std::log(1.001);
  EXPECT_NEAR(limit.contact_share, -2 * change, 1e-3);
}

// The share of the springs in the energy of a mode is by how much its squared frequency rises with theirs (Rayleigh). The
// estimate of the frequency is within a percent, in which it does not rise quite as evenly.
TEST_P(TimeStepLimits, TellTheShareOfContactInTheHighestMode) {
  for (const double stiffness : {1.0, 10.0}) {
    ThreeParticles three(GetParam());
    three.scene.time.estimate = TimeSpec::Estimate::highest_mode;
    three.scene.contact.stiffness = stiffness;
    three.scene.contact.inertance = 0.5;  // else balls have the largest gain
    const TimeStepLimit limit = three.limit();
    ASSERT_TRUE(limit.by_mode) << limit.gain;
    three.scene.contact.stiffness = 1.02 * stiffness;
    const double change = std::log(three.limit().stable / limit.stable) / std::log(1.02);
    EXPECT_NEAR(limit.contact_share, -2 * change, 0.01) << stiffness;
    three.scene.contact.stiffness = stiffness;
    three.scene.time.estimate = TimeSpec::Estimate::element;
    EXPECT_NEAR(limit.stable / three.limit().stable, limit.gain, 1e-12);
  }
}

// It takes hundreds of iterations, and nothing has changed since the start when the first step begins.
TEST_P(TimeStepLimits, KeepTheEstimateOfTheStartInTheFirstStep) {
  ThreeParticles three(GetParam());
  three.scene.time.estimate = TimeSpec::Estimate::highest_mode;
  Simulation simulation(three.scene);
  const double* gain = simulation.world().column<ModeGain>().values();  // of the first particle
  const double at_start = *gain;
  simulation.run_steps(1);
  EXPECT_EQ(*gain, at_start);
  EXPECT_GT(at_start, 1);
}

TEST_P(TimeStepLimits, SayWhyAStepIsShorter) {
  ThreeParticles three(GetParam());
  three.scene.stages[0].duration = 1e-4;
  EXPECT_EQ(three.limit().shortened, "the run ends");
  three.scene.stages[0].duration = 1;
  three.scene.bodies[1].velocity = Vec3(1e5, 0, 0);
  EXPECT_THAT(three.limit().shortened, StartsWith("surfaces move fast"));
  three.scene.bodies[1].velocity = Vec3::Zero();
  Simulation simulation(three.scene);
  simulation.world().resource<Clock>().dt *= 0.1;
  simulation.run_steps(1);
  EXPECT_EQ(time_step_limit(simulation.world()).shortened, "steps grow by at most 2%");
}

// Smooth surfaces bulge a little beyond the cylinders, which touch.
TEST(TimeStepLimit, SaysThatSurfacesOverlapAtTheStart) {
  ThreeParticles three(3);
  for (ParticleSpec& of : three.scene.particles) {
    of.shape = CylinderShape{.diameter = 1, .height = 1, .rounding = 0.05};
    of.hex_mesh = {.divisions = 4, .rings = 2, .axial_divisions = 6};
  }
  three.scene.bodies[1].position = Vec3(0, 0, 1);
  const TimeStepLimit limit = three.limit();
  EXPECT_EQ(limit.shortened, "surfaces overlap at the start");
  EXPECT_NEAR(limit.dt / limit.stable, 0.2 * 0.9, 1e-12);
}

}  // namespace
}  // namespace pulvis
