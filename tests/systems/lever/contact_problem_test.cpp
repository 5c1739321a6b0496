// The dense contact problem against Hertz: a rigid ball in an elastic half-space, whose compliance is
// Boussinesq's.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "systems/lever/solid_contact_problem.hpp"

namespace pulvis {
namespace {

constexpr double radius = 100, depth = 0.25, edge = 1, half = 6;  // E* = 1

struct Ball : TargetShape {
  Nearest nearest(const Place& p) const override {
    const Eigen::Vector3d off(p[0], p[1], p[2] + radius - depth);
    const double r = off.norm();
    const Eigen::Vector3d n = off / r;
    const Eigen::Matrix3d turn = (Eigen::Matrix3d::Identity() - n * n.transpose()) / r;
    Nearest found{r - radius, {n.x(), n.y(), n.z()}, {}};
    for (int i = 0; i < 9; ++i) found.turn[static_cast<std::size_t>(i)] = turn(i / 3, i % 3);
    return found;
  }
};

// Points an edge apart, each for a square; under an even load the middle of its own square sinks by
// 4 ln(1 + sqrt 2)/pi of the load over its edge.
ContactProblem half_space(const TargetShape& shape) {
  ContactProblem problem;
  problem.shape = &shape;
  for (double x = -half; x <= half; ++x)
    for (double y = -half; y <= half; ++y) {
      ContactPoint point;
      point.law = {1e6, 1e6, 0, 0, 1};
      point.place = point.before = Eigen::Vector3d(x * edge, y * edge, 0);
      point.force = point.old_tangential = Eigen::Vector3d::Zero();
      problem.points.push_back(point);
    }
  const auto count = static_cast<Eigen::Index>(problem.points.size());
  problem.compliance.setZero(3 * count, 3 * count);
  const double own = 4 * std::log(1 + std::sqrt(2.0)) / std::numbers::pi / edge;
  for (Eigen::Index i = 0; i < count; ++i)
    for (Eigen::Index j = 0; j < count; ++j) {
      const double apart = (problem.points[static_cast<std::size_t>(i)].place -
                            problem.points[static_cast<std::size_t>(j)].place)
                               .norm();
      const double s = i == j ? own : 1 / (std::numbers::pi * apart);
      for (int k = 0; k < 3; ++k)
        if (k == 2 || i == j) problem.compliance(3 * i + k, 3 * j + k) = s;
    }
  return problem;
}

TEST(ContactProblem, ABallInAHalfSpaceIsHertzs) {
  const Ball ball;
  const ContactProblem problem = half_space(ball);
  const ContactAnswer answer = solve_contact(problem);
  ASSERT_TRUE(answer.converged);
  EXPECT_LE(answer.iterations, 12);
  double force = 0, moment = 0;
  for (std::size_t i = 0; i < problem.points.size(); ++i) {
    const double f = answer.force[3 * static_cast<Eigen::Index>(i) + 2];
    EXPECT_GE(f, 0) << i;
    force += f;
    moment += f * problem.points[i].place.head<2>().squaredNorm();
  }
  const double a = std::sqrt(radius * depth);
  EXPECT_NEAR(force / (4.0 / 3 * std::sqrt(radius) * std::pow(depth, 1.5)), 1, 0.03);
  // The second moment of Hertz's pressure is 2/5 a^2.
  EXPECT_NEAR(std::sqrt(2.5 * moment / force) / a, 1, 0.03);
}

// The servo finds the depth for the force.
TEST(ContactProblem, TheServoFindsTheHeightOfItsForce) {
  const Ball ball;
  ContactProblem problem = half_space(ball);
  const double wanted = 4.0 / 3 * std::sqrt(radius) * std::pow(0.3, 1.5);
  problem.set_point = wanted;
  const ContactAnswer answer = solve_contact(problem);
  ASSERT_TRUE(answer.converged);
  EXPECT_NEAR(answer.force(Eigen::seqN(2, answer.force.size() / 3, 3)).sum() / wanted, 1, 1e-9);
  EXPECT_NEAR(depth + answer.height, 0.3, 0.03 * 0.3);
}

}  // namespace
}  // namespace pulvis
