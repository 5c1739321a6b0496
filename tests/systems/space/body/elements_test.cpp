// Elements of bodies in three dimensions against what forces of elements must do, whatever the element: patch test, rigid
// motion, force as the derivative of the energy, balance of momentum.
#include <gtest/gtest.h>

#include <numbers>

#include "tests/systems/space/body/blocks.hpp"

namespace pulvis::space {
namespace {

template <class F>
class Elements : public testing::Test {};
TYPED_TEST_SUITE(Elements, Formulations);

const Matrix some_gradient =
    (Matrix() << 1.1, 0.2, -0.1, 0.05, 0.9, 0.15, -0.2, 0.1, 1.05).finished();

Matrix turned(double angle) {
  return Eigen::AngleAxisd(angle, Vector(1, -2, 0.5).normalized()).toRotationMatrix();
}

bool inside(const Vector& x) { return x.minCoeff() > 0.1 && x.maxCoeff() < 0.9; }

// A homogeneous deformation of any mesh: the same stress everywhere, by the law of section 2 of docs/theory.md, and no
// force inside.
TYPED_TEST(Elements, PatchTest) {
  Body<TypeParam> body(distorted_block({3, 3, 3}, 0.25, 1), material(2.5, 0.3));
  body.place([](const Vector& x) -> Vector { return some_gradient * x + Vector(1, 2, 3); });
  body.find_forces();
  const double mu = 2.5 / 2.6, bulk = 2.5 / 1.2, j = some_gradient.determinant();
  const Matrix b = std::pow(j, -2.0 / 3) * some_gradient * some_gradient.transpose();
  const Matrix stress = mu / j * (b - b.trace() / 3 * Matrix::Identity()) +
                        bulk / 2 * (j - 1 / j) * Matrix::Identity();
  for (int e = 0; e < 27; ++e)
    for (int g = 0; g < TypeParam::points; ++g)
      EXPECT_LT((body.cauchy(e, g) - stress).norm(), 1e-13) << e;
  int looked_at = 0;
  for (int n = 0; n < body.nodes(); ++n) {
    const Point& p = body.shape().nodes[std::size_t(n)];
    const Vector x(p[0], p[1], p[2]);
    if (!inside(x)) continue;
    ++looked_at;
    EXPECT_LT(body.force(n).norm(), 1e-14);
  }
  EXPECT_EQ(looked_at, 8);
}

TYPED_TEST(Elements, RigidMotionHasNoForce) {
  Body<TypeParam> body(distorted_block({2, 2, 2}, 0.25, 2), material(1, 0.45));
  for (double angle = 0; angle <= 720; angle += 45) {
    const Matrix turn = turned(angle * std::numbers::pi / 180);
    body.place([&](const Vector& x) -> Vector { return turn * x + Vector(0.3, 0.2, 0.1); });
    body.find_forces();
    for (int n = 0; n < body.nodes(); ++n) EXPECT_LT(body.force(n).norm(), 1e-14);
  }
}

// Moves every node somewhere near where a homogeneous deformation takes it.
template <class B>
void shake(B& body, Random& random, double by) {
  body.place([&](const Vector& x) {
    return Vector(some_gradient * x +
                  by * Vector(random.in(-1, 1), random.in(-1, 1), random.in(-1, 1)));
  });
}

// f = -dE/dx by central differences: exact but for round-off and the third derivative, 1e-8 of the largest.
template <class B>
void expect_forces_of_energy(B& body) {
  body.find_forces();
  std::vector<Vector> force;
  double largest = 0;
  for (int n = 0; n < body.nodes(); ++n) {
    force.push_back(body.force(n));
    largest = std::max(largest, force.back().norm());
  }
  const double h = 1e-5;
  for (int n = 0; n < body.nodes(); ++n)
    for (int k = 0; k < 3; ++k) {
      const Vector at = body.position(n), step = h * Vector::Unit(k);
      body.put(n, at + step);
      const double plus = body.stored_energy();
      body.put(n, at - step);
      const double minus = body.stored_energy();
      body.put(n, at);
      EXPECT_NEAR(force[std::size_t(n)][k], (minus - plus) / (2 * h), 1e-7 * largest);
    }
}

TYPED_TEST(Elements, ForceIsTheDerivativeOfTheEnergy) {
  Random random(3);
  Body<TypeParam> body(distorted_block({2, 1, 1}, 0.2, 4), material(2, 0.4));
  shake(body, random, 0.05);
  expect_forces_of_energy(body);
}

// The same above a plastic history: the stress of a state that does not flow any more.
TYPED_TEST(Elements, ForceIsTheDerivativeOfTheEnergyAfterFlow) {
  Random random(5);
  Body<TypeParam> body(distorted_block({2, 1, 1}, 0.2, 6), material(2, 0.3, 0.02, 0.1));
  for (int i = 0; i < 3; ++i) {
    shake(body, random, 0.05);
    body.find_forces();
  }
  // From now on the material bears anything.
  for (int l = 0; l < lane_count; ++l) body.template number<YieldStress>(0, 0, l) = 1e6;
  EXPECT_GT(body.template number<PlasticStrain<TypeParam::points>>(0), 0.01);
  if constexpr (TypeParam::stabilised) {
    EXPECT_NE(body.template number<PlasticHourglass<ThreeD>>(0, 4), 0);
  }
  shake(body, random, 0.05);
  expect_forces_of_energy(body);
}

// Internal forces balance, and have no moment: to round-off of the largest.
TYPED_TEST(Elements, ForcesBalance) {
  Random random(7);
  Body<TypeParam> body(distorted_block({2, 2, 2}, 0.2, 8), material(2, 0.3, 0.05, 0.1));
  for (int i = 0; i < 3; ++i) {
    shake(body, random, 0.05);
    body.find_forces();
    Vector sum = Vector::Zero(), moment = Vector::Zero();
    double largest = 0;
    for (int n = 0; n < body.nodes(); ++n) {
      sum += body.force(n);
      moment += body.position(n).cross(body.force(n));
      largest = std::max(largest, body.force(n).norm());
    }
    EXPECT_LT(sum.norm(), 1e-14 * largest);
    EXPECT_LT(moment.norm(), 1e-14 * largest);
  }
}

// A motion seen from a turning frame: forces turn with it over two turns, whatever flows.
TYPED_TEST(Elements, FramesDoNotMatter) {
  const MaterialSpec m = material(2, 0.3, 0.03, 0.1);
  const Shape shape = distorted_block({2, 1, 1}, 0.2, 9);
  Body<TypeParam> fixed(shape, m), turning(shape, m);
  for (int i = 0; i <= 16; ++i) {
    const Matrix turn = turned(i * std::numbers::pi / 4);
    Random random(std::uint64_t(10 + i)), same(std::uint64_t(10 + i));
    shake(fixed, random, 0.05);
    fixed.find_forces();
    shake(turning, same, 0.05);
    for (int n = 0; n < turning.nodes(); ++n) turning.put(n, turn * turning.position(n));
    turning.find_forces();
    for (int n = 0; n < fixed.nodes(); ++n)
      EXPECT_LT((turning.force(n) - turn * fixed.force(n)).norm(), 1e-13) << i;
  }
  EXPECT_GT(fixed.template number<PlasticStrain<TypeParam::points>>(0), 0.1);
}

}  // namespace
}  // namespace pulvis::space
