// Bonds in three dimensions: forces from an energy, momentum, fracture energy in any mode, welding by pressure.
#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "components/space/bond.hpp"
#include "tests/systems/space/contact/balls.hpp"
#include "tests/systems/space/contact/energy_gradient.hpp"

namespace pulvis::space {
namespace {

constexpr double strength = 100e6;                 // Pa
constexpr double weak = 4e3, unbreakable = 100e6;  // J/m^2

// The steel of the balls to `other`.
BondSpec glue(double fracture_energy, const char* other = "steel") {
  BondSpec bond;
  bond.origin = BondSpec::Origin::initial;
  bond.first = "steel";
  bond.second = other;
  bond.strength = fracture_energy == unbreakable ? 500 * strength : strength;
  bond.fracture_energy = fracture_energy;
  bond.reach = 0.3;
  bond.stiffness = 1;
  return bond;
}
BondSpec weld(const char* other = "steel") {
  BondSpec bond = glue(weak, other);
  bond.origin = BondSpec::Origin::pressed;
  bond.threshold = 100e6;
  bond.growth = 0.1;
  return bond;
}

// Two balls that nearly touch, bonded across their gap.
struct GluedBalls : TwoBalls {
  Vec3 axis, side;

  explicit GluedBalls(double fracture_energy, const FrictionSpec& friction = {},
                      double depth = -60e-6)
      : TwoBalls(depth, 4, friction, {glue(fracture_energy)}) {
    axis = bodies[1].position.normalized();
    side = axis.cross(Vec3::UnitZ()).normalized();
    world.resource<Clock>().dt_before = 1e-8;
    update();
    bond();
    update(false);
  }
  void shift(const Vec3& by) {
    move(1, [&](const Vec3& x) { return Vec3(x + by); });
    update(false);
  }
  void turn(int body, const Vec3& vector) {
    const Rotation rotation(Eigen::AngleAxisd(vector.norm(), vector.normalized()));
    move(body, [&](const Vec3& x) { return Vec3(rotation * x); });
  }
  double broken_area() const { return bonds().crack_size; }
};

TEST(SpaceBonds, CarryNothingWhereTheyWereMade) {
  GluedBalls w(unbreakable);
  EXPECT_GT(w.bonds().made[0], 50);
  EXPECT_GT(w.bonds().area, 1e-6);
  EXPECT_LT(w.bonds().energy,
            1e-14);  // J, round-off of places on bonds ten times as stiff as the balls
}

TEST(SpaceBonds, ForceIsMinusTheGradientOfTheEnergy) {
  for (const Vec3& by : {Vec3(3e-6, 0, 0), Vec3(0, 4e-6, 0), Vec3(2e-6, 3e-6, -4e-6)}) {
    GluedBalls w(unbreakable);
    w.turn(1, {1e-4, -2e-4, 1e-4});
    w.shift(by.x() * w.axis + by.y() * w.side + by.z() * w.axis.cross(w.side));
    ASSERT_GT(w.bonds().energy, 0);
    expect_gradient_of_energy(w);
    EXPECT_EQ(w.bonds().fracture, 0);
  }
}

TEST(SpaceBonds, WithToolsForceIsMinusTheGradientOfTheEnergy) {
  std::mt19937_64 random(1);
  BallOnFloor w(0, {}, any_rotation(random), {glue(unbreakable, "floor")});
  w.update();
  w.bond();
  ASSERT_GT(w.bonds().made[0], 50);
  w.move(0, [](const Vec3& x) { return Vec3(x + Vec3(2e-6, -1e-6, 3e-6)); });
  w.update(false);
  ASSERT_GT(w.bonds().energy, 0);
  expect_gradient_of_energy(w);
  EXPECT_LT(w.force_on(0).z(), 0);
  EXPECT_LT(w.force_on(0).x(), 0);
}

// Twice round, together: what is stored, and the forces in the frame of the bodies, do not change.
TEST(SpaceBonds, TurnWithTheBodies) {
  GluedBalls w(unbreakable);
  w.shift(3e-6 * w.axis + 4e-6 * w.side);
  const double energy = w.energy();
  const Vec3 force = w.force_on(0);
  const Vec3 step = Vec3(1, -2, 0.5).normalized() * (0.05 * std::numbers::pi);
  for (int i = 0; i < 80; ++i) {
    for (const int body : {0, 1}) w.turn(body, step);
    w.update(i % 8 == 0);
  }
  EXPECT_NEAR(w.energy(), energy, 1e-9 * energy);
  EXPECT_LT((w.force_on(0) - force).norm(), 1e-9 * force.norm());
}

// Action and reaction while bonds break, with friction where they are pressed.
TEST(SpaceBonds, KeepMomentumAndMoment) {
  GluedBalls w(weak, coulomb(0.4), 60e-6);
  std::mt19937_64 random(5);
  const Vec3 omega = 3e3 * any_direction(random);
  w.set_velocity(0, [&](const Vec3& x) { return Vec3(20 * w.side + omega.cross(x)); });
  for (int step = 0; step < 12; ++step) {
    w.turn(1, {1e-3, 0, 2e-3});
    w.shift(6e-6 * w.side + 2e-6 * w.axis);
    const double force = w.force_on(0).norm();
    ASSERT_GT(force, 1);
    EXPECT_LT((w.force_on(0) + w.force_on(1)).norm(), 1e-12 * force) << step;
    EXPECT_LT((w.moment_on(0) + w.moment_on(1)).norm(), 1e-11 * force * diameter) << step;
  }
  EXPECT_GT(w.broken_area(), 0);
  EXPECT_GT(w.bonds().area, 0);
}

// Whatever the direction, the fracture energy per area, which is the work of the forces; also where the surfaces overlap at
// the start: what that would store in contacts is not there to push them apart.
TEST(SpaceBonds, TakeTheirFractureEnergyInAnyMode) {
  for (const auto& [angle, depth] :
       {std::pair(0.0, -60e-6), {35.0, -60e-6}, {70.0, -60e-6}, {0.0, 20e-6}, {35.0, 20e-6}}) {
    GluedBalls w(weak, {}, depth);
    const double area = w.bonds().area, start = w.energy();
    const double radians = angle * std::numbers::pi / 180;
    const Vec3 way = std::cos(radians) * w.axis + std::sin(radians) * w.side;
    double work = 0;
    for (int step = 0; step < 2000 && w.bonds().area > 0; ++step) {
      const Vec3 before = w.force_on(1);
      w.shift(0.1e-6 * way);
      work -= 0.5e-7 * (before + w.force_on(1)).dot(way);
    }
    EXPECT_EQ(w.bonds().area, 0) << angle;
    EXPECT_NEAR(w.broken_area(), area, 1e-9 * area);
    EXPECT_NEAR(w.bonds().fracture, weak * area, 1e-6 * weak * area) << angle;
    EXPECT_NEAR(work, w.bonds().fracture + w.energy() - start, 0.01 * weak * area) << angle;
  }
}

// At the contact pressure p a weld gets the strength growth (p - threshold), once the pressure has halved.
TEST(SpaceBonds, FormByPressure) {
  TwoBalls w(30e-6, 1, {}, {weld()});
  const Vec3 axis = w.bodies[1].position.normalized();
  const auto part = [&](double by) {
    w.move(1, [&](const Vec3& x) { return Vec3(x + by * axis); });
    w.update(false);
  };
  w.update();
  w.update(false);
  EXPECT_EQ(w.bonds().area, 0);
  const auto& pressures = w.world.column<WeldPressure<FaceContact>>();
  const double largest = *std::max_element(pressures.values(),
                                           pressures.values() + face_points * pressures.table.rows);
  ASSERT_GT(largest, 150e6);
  for (int i = 0; i < 40; ++i) part(0.5e-6);
  const auto& shares = w.world.column<BondStrength<FaceContact>>();
  const double strongest =
      *std::max_element(shares.values(), shares.values() + face_points * shares.table.rows);
  EXPECT_NEAR(strongest, std::min(1.0, 0.1 * (largest - 100e6) / strength), 1e-9);
  EXPECT_GT(w.bonds().area, 0);
  for (int i = 0; i < 30; ++i) part(0.5e-6);
  EXPECT_GT(w.force_on(0).dot(axis), 0);  // it holds
}

TEST(SpaceBonds, FormByPressureOnTools) {
  BallOnFloor w(20e-6, {}, Rotation::Identity(), {weld("floor")});
  w.update();
  EXPECT_EQ(w.bonds().area, 0);
  for (int i = 0; i < 50; ++i) {
    w.move(0, [](const Vec3& x) { return Vec3(x + Vec3(0, 0, 0.5e-6)); });
    w.update(false);
  }
  EXPECT_GT(w.bonds().area, 0);
  EXPECT_LT(w.force_on(0).z(), 0);
  // In one step out of reach: the pressure has dropped there as well.
  BallOnFloor far(20e-6, {}, Rotation::Identity(), {weld("floor")});
  far.update();
  far.move(0, [](const Vec3& x) { return Vec3(x + Vec3(0, 0, 21e-6)); });
  far.update(false);
  far.update(false);
  EXPECT_GT(far.bonds().area, 0);
}

}  // namespace
}  // namespace pulvis::space
