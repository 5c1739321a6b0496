// Bulk damping in three dimensions against Rayleigh's law: f = -alpha M v - beta K v, with the very K of the elements; nothing
// in a rigid motion of any size.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/systems/space/body/blocks.hpp"

namespace pulvis::space {
namespace {

constexpr double alpha = 300, beta = 2e-7, stiff_modulus = 2e9, stiff_poisson = 0.3;

MaterialSpec damped_material(double mass, double stiffness) {
  MaterialSpec m = material(stiff_modulus, stiff_poisson);
  m.mass_damping = mass;
  m.stiffness_damping = stiffness;
  return m;
}

// A block of a mesh that is nowhere regular.
template <class F>
class DampedBlock : public Body<F> {
 public:
  DampedBlock(double mass, double stiffness)
      : Body<F>(distorted_block({2, 2, 2}, 0.15, 3), damped_material(mass, stiffness)) {
    this->world.template resource<Clock>().dt_before = 1e-9;
    this->world.template resource<Clock>().step = 5;
  }
  void set_velocity(const std::function<Vector(int)>& of_node) {
    for (int n = 0; n < this->nodes(); ++n)
      for (int k = 0; k < 3; ++k)
        for (int l = 0; l < lane_count; ++l)
          this->template number<Velocity<ThreeD>>(n, k, l) = of_node(n)[k];
  }
  void find_damping() { this->template run<damping_force<F>>(); }
  Vector damping(int n) {
    return {this->template number<DampingForce<ThreeD>>(n, 0),
            this->template number<DampingForce<ThreeD>>(n, 1),
            this->template number<DampingForce<ThreeD>>(n, 2)};
  }
};

template <class F>
class SpaceDamping : public testing::Test {};
TYPED_TEST_SUITE(SpaceDamping, Formulations);

// What all nodes' forces change by when everything moves by a very little, is K times that.
TYPED_TEST(SpaceDamping, OfStiffnessIsBetaTimesTheStiffnessOfTheElements) {
  DampedBlock<TypeParam> b(0, beta);
  Random random(8);
  std::vector<Vector> u;
  for (int n = 0; n < b.nodes(); ++n)
    u.emplace_back(random.in(-1, 1), random.in(-1, 1), random.in(-1, 1));
  constexpr double h = 1e-7;
  std::vector<Vector> elastic;
  for (const double sign : {-1.0, 1.0}) {
    for (int n = 0; n < b.nodes(); ++n) {
      const Point& p = b.shape().nodes[std::size_t(n)];
      b.put(n, Vector(p[0], p[1], p[2]) + sign * h * u[std::size_t(n)]);
    }
    b.find_forces();
    for (int n = 0; n < b.nodes(); ++n) {
      if (sign < 0)
        elastic.push_back(b.force(n));
      else
        elastic[std::size_t(n)] = (b.force(n) - elastic[std::size_t(n)]) / (2 * h);
    }
  }
  b.place([](const Vector& x) { return x; });
  b.set_velocity([&](int n) { return u[std::size_t(n)]; });
  b.find_damping();
  double greatest = 0;
  for (const Vector& f : elastic) greatest = std::max(greatest, beta * f.norm());
  ASSERT_GT(greatest, 0);
  for (int n = 0; n < b.nodes(); ++n)
    EXPECT_LT((b.damping(n) - beta * elastic[std::size_t(n)]).norm(), 1e-6 * greatest) << n;
}

// It is part of the force on the node, which integrate takes.
TYPED_TEST(SpaceDamping, IsPartOfTheInternalForce) {
  DampedBlock<TypeParam> b(alpha, beta);
  b.place([](const Vector& x) { return x; });
  b.set_velocity([&](int n) { return Vector(1.0 * n, 2, -3); });
  b.find_forces();
  const Vector before = b.force(4);
  b.find_damping();
  EXPECT_EQ(b.force(4), before + b.damping(4));
}

// A turn by 0.3 between two steps, as the leapfrog makes it: the velocities are those of the chord.
TYPED_TEST(SpaceDamping, OfStiffnessSeesNothingInARigidTurn) {
  DampedBlock<TypeParam> b(0, beta);
  constexpr double dt = 1e-8, angle = 0.3;
  b.world.template resource<Clock>().dt_before = dt;
  const Matrix turn = Eigen::AngleAxisd(angle, Vector(1, 2, -1).normalized()).toRotationMatrix();
  b.place([&](const Vector& x) { return turn * x; });
  b.set_velocity([&](int n) {
    const Point& p = b.shape().nodes[std::size_t(n)];
    const Vector x(p[0], p[1], p[2]);
    return Vector((turn * x - x) / dt);
  });
  b.find_damping();
  for (int n = 0; n < b.nodes(); ++n)
    EXPECT_LT(b.damping(n).norm(), 1e-11 * beta * stiff_modulus * angle / dt);
}

// Far from its undeformed state, too, the forces have no sum and no moment, and take energy.
TYPED_TEST(SpaceDamping, OfStiffnessKeepsMomentumAndTakesEnergy) {
  DampedBlock<TypeParam> b(0, beta);
  Matrix f;
  f << 1.2, 0.3, -0.1, 0.1, 0.8, 0.2, -0.2, 0.1, 1.1;
  b.place([&](const Vector& x) { return f * x; });
  Random random(2);
  b.set_velocity([&](int) { return Vector(random.in(-9, 9), random.in(-9, 9), random.in(-9, 9)); });
  b.find_damping();
  Vector sum = Vector::Zero(), moment = Vector::Zero();
  double size = 0;
  for (int n = 0; n < b.nodes(); ++n) {
    sum += b.damping(n);
    moment += b.position(n).cross(b.damping(n));
    size += b.damping(n).norm();
  }
  EXPECT_LT(sum.norm(), 1e-12 * size);
  EXPECT_LT(moment.norm(), 1e-12 * size);
  EXPECT_GT(b.template number<DampingWork>(0), 0);
}

TYPED_TEST(SpaceDamping, OfMassIsAlphaTimesTheMomentumOfTheNode) {
  DampedBlock<TypeParam> b(alpha, 0);
  b.place([](const Vector& x) { return x; });
  const Vector v(3, -4, 5);
  b.set_velocity([&](int) { return v; });
  b.find_damping();
  for (int n = 0; n < b.nodes(); ++n) {
    const double mass = 1000 * b.shape().nodal_volume[std::size_t(n)];
    EXPECT_LT((b.damping(n) + alpha * mass * v).norm(), 1e-13 * alpha * mass * v.norm());
  }
}

}  // namespace
}  // namespace pulvis::space
