// Friction in three dimensions: Coulomb's law, static and dynamic, its springs, what it spends, how it turns.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "tests/systems/space/contact/balls.hpp"

namespace pulvis::space {
namespace {

TEST(SpaceFriction, IsMuTimesThePressureAgainstTheSlipInEveryDirection) {
  constexpr double mu = 0.3;
  std::mt19937_64 random(4);
  for (int i = 0; i < 8; ++i) {
    BallOnFloor w(100e-6, coulomb(mu), any_rotation(random));
    w.update();
    const double angle = 2 * std::numbers::pi * i / 8;
    const Vec3 direction(std::cos(angle), std::sin(angle), 0);
    for (int step = 0; step < 100; ++step) w.slide(100 * direction);
    const Vec3 force = w.force_on(0);
    ASSERT_GT(force.z(), 1e3);
    EXPECT_LT((force - Vec3(0, 0, force.z()) + mu * force.z() * direction).norm(),
              1e-9 * force.z());
  }
}

TEST(SpaceFriction, SticksLikeASpringBelowThat) {
  BallOnFloor w(100e-6, coulomb(0.5), Rotation::Identity());
  w.update();
  const double energy = w.energy(), normal = w.force_on(0).z();
  double slipped = 0;
  for (int step = 0; step < 10; ++step) {
    w.slide(Vec3(0.01, 0, 0));
    slipped += 0.01 * w.world.resource<Clock>().dt_before;
  }
  const double force = -w.force_on(0).x();
  EXPECT_GT(force, 0);
  EXPECT_LT(force, 0.01 * normal);
  EXPECT_NEAR(w.energy() - energy, 0.5 * force * slipped, 1e-3 * force * slipped + 1e-12 * energy);
}

// Of a path at random: what friction spends in a step is never negative while the pressure stays, and with what its springs
// keep it is the work against it.
TEST(SpaceFriction, SpendsWhatIsDoneAgainstIt) {
  std::mt19937_64 random(9);
  BallOnFloor w(100e-6, coulomb(0.3), any_rotation(random));
  w.update();
  const double energy = w.energy(), dt = w.world.resource<Clock>().dt_before;
  double work = 0, spent = 0;
  for (int step = 0; step < 300; ++step) {
    Vec3 velocity = 40 * any_direction(random);
    velocity.z() = 0;
    const Vec3 before = w.force_on(0);
    w.slide(velocity);
    work -= 0.5 * (before + w.force_on(0)).dot(velocity) * dt;
    const double now = w.world.resource<Totals>().friction_work;
    EXPECT_GE(now, spent);
    spent = now;
  }
  EXPECT_GT(spent, 0);
  EXPECT_NEAR(spent + w.energy() - energy, work, 1e-3 * work);
}

// A pair that turns as a whole turns its forces, those of friction as well: a quarter turn in many steps, about the normal
// and across it.
TEST(SpaceFriction, TurnsWithThePair) {
  for (const bool about_normal : {true, false}) {
    TwoBalls w(250e-6, 2, coulomb(0.4));
    Clock& clock = w.world.resource<Clock>();
    clock.dt_before = 1e-8;
    w.update();
    const Vec3 axis = w.bodies[1].position.normalized();
    w.set_velocity(0, [&](const Vec3&) { return Vec3(20 * axis.unitOrthogonal()); });
    w.update(false);
    const Vec3 force = w.force_on(0);
    ASSERT_GT(force.cross(axis).norm(), 1e-3 * force.norm());
    constexpr int steps = 400;
    const double angle = std::numbers::pi / 2 / steps;
    const Eigen::AngleAxisd turn(angle, about_normal ? axis : Vec3(axis.unitOrthogonal()));
    for (int step = 0; step < steps; ++step) {
      for (int body = 0; body < 2; ++body) {
        w.set_velocity(body, [&](const Vec3& x) { return Vec3((turn * x - x) / clock.dt_before); });
        w.move(body, [&](const Vec3& x) { return Vec3(turn * x); });
      }
      w.update(false);
    }
    const Vec3 expected = Eigen::AngleAxisd(angle * steps, turn.axis()) * force;
    // Of the friction: a step turns its spring to second order.
    EXPECT_LT((w.force_on(0) - expected).norm(), 0.02 * force.cross(axis).norm());
  }
}

// ---- more than a coefficient -------------------------------------------------------------------------------
FrictionSpec weakening(double dynamic, double at_rest, double decay_length) {
  FrictionSpec friction = coulomb(dynamic);
  friction.static_coefficient = at_rest;
  friction.decay_length = decay_length;
  return friction;
}

double friction_over_pressure(TouchingBodies& w) {
  const Vec3 force = w.force_on(0);
  return std::hypot(force.x(), force.y()) / force.z();
}

// While nothing has slid far it is the static coefficient, once all has faded the dynamic one, to the last digits.
TEST(SpaceFriction, LiesBetweenTheStaticAndTheDynamicCoefficient) {
  for (const auto& [decay_length, expected] : {std::pair(1e6, 0.4), std::pair(1e-12, 0.1)}) {
    BallOnFloor w(100e-6, weakening(0.1, 0.4, decay_length), Rotation::Identity());
    w.update();
    for (int step = 0; step < 200; ++step) w.slide(Vec3(60, 80, 0));
    EXPECT_NEAR(friction_over_pressure(w), expected, 1e-6);
  }
}

// As e^(-distance / decay length), from wherever one begins to look.
TEST(SpaceFriction, FadesWithTheDistanceThatIsSlid) {
  constexpr double decay_length = 1e-3, step_length = 1e-6;
  BallOnFloor w(20e-6, weakening(0.1, 0.4, decay_length), Rotation::Identity());
  w.update();
  std::vector<double> left;
  for (int step = 0; step < 2000; ++step) {
    w.slide(Vec3(0, 100, 0));
    left.push_back(friction_over_pressure(w) - 0.1);
  }
  for (const std::size_t further : {300, 800, 1500})
    EXPECT_NEAR(std::log(left[200] / left[200 + further]),
                static_cast<double>(further) * step_length / decay_length, 0.01);
}

// Once the surfaces have parted the static part is back.
TEST(SpaceFriction, IsStaticAgainAfterTheSurfacesHaveParted) {
  BallOnFloor w(50e-6, weakening(0.1, 0.4, 20e-6), Rotation::Identity());
  w.update();
  for (int step = 0; step < 400; ++step) w.slide(Vec3(100, 0, 0));
  ASSERT_NEAR(friction_over_pressure(w), 0.1, 1e-3);
  for (const double z : {200e-6, -200e-6}) {
    w.move(0, [&](const Vec3& x) { return Vec3(x + z * Vec3::UnitZ()); });
    w.update(false);
  }
  double greatest = 0;
  for (int step = 0; step < 40; ++step) {
    w.slide(Vec3(100, 0, 0));
    greatest = std::max(greatest, friction_over_pressure(w));
  }
  EXPECT_GT(greatest, 0.2);
}

TEST(SpaceFriction, GrowsWithTheSpeedAsTheLawSays) {
  FrictionSpec law = coulomb(0.2);
  law.rate = 0.05;
  law.reference_speed = 2;
  BallOnFloor w(50e-6, law, Rotation::Identity());
  w.update();
  for (const double speed : {80.0, 40.0}) {
    for (int step = 0; step < 200; ++step) w.slide(Vec3(speed, 0, 0));
    EXPECT_NEAR(friction_over_pressure(w), 0.2 + 0.05 * std::log(1 + speed / 2), 1e-6);
  }
}

// Between particles: at rest as with the static coefficient alone, faded as with the dynamic one.
TEST(SpaceFriction, OfTwoBallsHasTheSameTwoEnds) {
  const auto force = [](const FrictionSpec& law) {
    TwoBalls w(250e-6, 2, law);
    w.world.resource<Clock>().dt_before = 1e-8;
    w.update();
    const Vec3 across = w.bodies[1].position.normalized().unitOrthogonal();
    w.set_velocity(0, [&](const Vec3&) { return Vec3(3000 * across); });
    for (int step = 0; step < 100; ++step) w.update(false);
    EXPECT_LT((w.force_on(0) + w.force_on(1)).norm(), 1e-12 * w.force_on(0).norm());
    EXPECT_LT((w.moment_on(0) + w.moment_on(1)).norm(), 1e-11 * w.force_on(0).norm() * diameter);
    return w.force_on(0);
  };
  const Vec3 at_rest = force(coulomb(0.4)), sliding = force(coulomb(0.1));
  ASSERT_GT((at_rest - sliding).norm(), 0.1 * sliding.norm());
  EXPECT_LT((force(weakening(0.1, 0.4, 1e6)) - at_rest).norm(), 1e-6 * at_rest.norm());
  EXPECT_LT((force(weakening(0.1, 0.4, 1e-12)) - sliding).norm(), 1e-6 * sliding.norm());
}

}  // namespace
}  // namespace pulvis::space
