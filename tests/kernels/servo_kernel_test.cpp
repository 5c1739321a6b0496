// A tool that holds a force against a spring: it reaches it, does not swing up, and keeps to its speed.
#include "systems/servo_kernel.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace pulvis::kernels {
namespace {

struct Run {
  double force, largest, fastest;
};

// Against a spring of stiffness k (N/m); mass and dashpot as for a block that it damps critically at k = 1e8.
Run against_spring(double k, int steps, double allowed) {
  const double mass = 0.008, damping = 0.5 * std::sqrt(1e8 * mass), dt = 1e-7, wanted = 1e4;
  double momentum = 0, way = 0;
  Run run{};
  for (int i = 0; i < steps; ++i) {
    run.force = k * way;
    const ServoStep next = servo_step(momentum, wanted - run.force, mass, damping, allowed, dt);
    momentum = next.momentum;
    way += next.velocity * dt;
    run.largest = std::max(run.largest, run.force);
    run.fastest = std::max(run.fastest, std::abs(next.velocity));
  }
  return run;
}

TEST(ServoStep, ReachesItsForceAgainstAnySpring) {
  for (const double k : {1e6, 1e7, 1e8, 1e9})
    EXPECT_NEAR(against_spring(k, 400000, 1e3).force, 1e4, 1);
}

// It takes what a spring 100 times softer or 10 times stiffer than it is made for gives without swinging up:
// a mass on a spring would pass a force that is asked for at once by its whole size.
TEST(ServoStep, IsPassive) {
  for (const double k : {1e6, 1e8, 1e9}) EXPECT_LT(against_spring(k, 400000, 1e3).largest, 1.8e4);
  EXPECT_LT(against_spring(1e8, 400000, 1e3).largest, 1.2e4);
}

TEST(ServoStep, KeepsToItsSpeed) {
  EXPECT_LE(against_spring(1e8, 20000, 0.5).fastest, 0.5);
  EXPECT_DOUBLE_EQ(servo_step(0, 1e9, 1, 1, 2.0, 1).velocity, 2);
  EXPECT_DOUBLE_EQ(servo_step(0, 1e9, 1, 1, 2.0, 1).momentum, 2);
}

}  // namespace
}  // namespace pulvis::kernels
