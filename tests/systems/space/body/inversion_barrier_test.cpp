// What keeps elements with one point from turning inside out, against the laws of a stored energy.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/run_failure.hpp"
#include "systems/space/body/inversion_barrier_kernel.hpp"
#include "tests/systems/space/body/blocks.hpp"

namespace pulvis::space {
namespace {

constexpr double modulus = 2, poisson = 0.3, rigidity = modulus / (2 * (1 + poisson));

double sign_at(const Vector& x, int k) { return x[k] < 0.5 ? -1 : 1; }

// Fibres along x of the unit cube shorten at one side and lengthen at the other: det F at the Gauss points becomes
// 1 -+ 2 by/sqrt 3, and the mean does not change.
Vector bent(const Vector& x, double by) {
  return Vector(x[0] + by * sign_at(x, 0) * sign_at(x, 1), x[1], x[2]);
}
double bending_of_ratio(double r) { return (1 - r) * std::sqrt(3.0) / 2; }

Shape unit_cube() {
  return block({1, 1, 1}, [](const Vector& x) { return x; });
}

kernels::ElementModes<double> modes_of_body(Body<OnePoint>& body, int lane = 0) {
  const auto of = [&](int k) {
    return kernels::modes_of<double>([&](int i) {
      return body.number<Position<ThreeD>>(entry(body.shape().hexahedra[0], i).value, k, lane);
    });
  };
  return {of(0), of(1), of(2)};
}

double mean_determinant(const Shape& shape, const kernels::ElementModes<double>& modes) {
  const auto f = kernels::deformation_gradient(modes, shape.element[0].gradient);
  return kernels::determinant(f, kernels::adjugate(f));
}
double least_ratio_of(Body<OnePoint>& body) {
  const auto modes = modes_of_body(body);
  return kernels::least_of(kernels::gauss_determinants(modes, body.shape().gauss[0])) /
         mean_determinant(body.shape(), modes);
}

// A cube with a corner at ratio about r, stretched and sheared besides, its corners shaken.
void close_a_corner(Body<OnePoint>& body, double r, std::uint64_t seed) {
  Random random(seed);
  const Matrix f = (Matrix() << 1.1, 0.2, -0.1, 0.05, 0.9, 0.15, -0.2, 0.1, 1.05).finished();
  body.place([&](const Vector& x) {
    const double a = random.in(-1, 1), b = random.in(-1, 1);
    return Vector(f * bent(x, bending_of_ratio(r)) + 0.02 * Vector(a, b, random.in(-1, 1)));
  });
}

// f = -dE/dx by central differences: round-off and the third derivative leave 1e-7 of the largest.
TEST(InversionBarrier, ForceIsTheDerivativeOfTheEnergy) {
  for (const double r : {0.25, 0.15, 0.1}) {
    Body<OnePoint> body(unit_cube(), material(modulus, poisson));
    close_a_corner(body, r, 1);
    ASSERT_LT(least_ratio_of(body), 0.3);
    ASSERT_GT(least_ratio_of(body), 0);
    body.find_forces();
    std::vector<Vector> force;
    for (int n = 0; n < 8; ++n) force.push_back(body.force(n));
    const double h = 1e-6;
    for (int n = 0; n < 8; ++n)
      for (int k = 0; k < 3; ++k) {
        const Vector at = body.position(n), step = h * Vector::Unit(k);
        body.put(n, at + step);
        const double plus = body.stored_energy();
        body.put(n, at - step);
        const double minus = body.stored_energy();
        body.put(n, at);
        EXPECT_NEAR(force[std::size_t(n)][k], (minus - plus) / (2 * h), 1e-7) << r;
      }
  }
}

TEST(InversionBarrier, ForcesBalanceAndTurnWithTheFrame) {
  Body<OnePoint> fixed(unit_cube(), material(modulus, poisson)),
      turning(unit_cube(), material(modulus, poisson));
  close_a_corner(fixed, 0.1, 2);
  fixed.find_forces();
  for (int i = 1; i < 8; ++i) {
    const Matrix turn =
        Eigen::AngleAxisd(i * 0.7853981633974483, Vector(1, -2, 0.5).normalized()).matrix();
    Vector sum = Vector::Zero(), moment = Vector::Zero();
    for (int n = 0; n < 8; ++n) turning.put(n, turn * fixed.position(n));
    turning.find_forces();
    for (int n = 0; n < 8; ++n) {
      EXPECT_LT((turning.force(n) - turn * fixed.force(n)).norm(), 1e-12) << i;
      sum += turning.force(n);
      moment += turning.position(n).cross(turning.force(n));
    }
    EXPECT_LT(sum.norm(), 1e-13);
    EXPECT_LT(moment.norm(), 1e-13);
  }
}

// The bound that spares elements the eight determinants: below 1 none has a ratio below 0.3, whatever its form;
// and some that it spares come near, so that it is of use.
TEST(InversionBarrier, HarmlessHourglassesAreKnown) {
  Random random(3);
  double least = 1;
  for (int i = 0; i < 2000; ++i) {
    const Shape shape = distorted_block({1, 1, 1}, i % 2 ? 0.25 : 0.1, std::uint64_t(i));
    const Shape::Element& e = shape.element[0];
    std::array<std::array<double, 8>, 3> x;
    const double by = random.in(0, 0.6);
    for (int n = 0; n < 8; ++n)
      for (int k = 0; k < 3; ++k)
        x[std::size_t(k)][std::size_t(n)] =
            shape.nodes[std::size_t(entry(shape.hexahedra[0], n).value)][std::size_t(k)] +
            by * random.in(-1, 1);
    const auto of = [&](const auto& row) {
      return kernels::modes_of<double>([&](int c) { return row[std::size_t(c)]; });
    };
    const kernels::ElementModes<double> modes{of(x[0]), of(x[1]), of(x[2])};
    const auto f = kernels::deformation_gradient(modes, e.gradient);
    const auto adj = kernels::adjugate(f);
    const double j = kernels::determinant(f, adj);
    const auto p = kernels::hourglass_components(modes, kernels::to_fibres(e.fibre, adj, 1 / j), e);
    if (!(kernels::closing_measure(p, e) < 1)) continue;
    for (const double at : kernels::gauss_determinants(modes, shape.gauss[0])) {
      EXPECT_GT(at / j, 0.3);
      least = std::min(least, at / j);
    }
  }
  EXPECT_LT(least, 0.6);
}

// Whatever stands in the same register: the same bits.
TEST(InversionBarrier, LeavesElementsFarFromFoldingAlone) {
  Body<OnePoint> alone(unit_cube(), material(modulus, poisson)),
      beside(unit_cube(), material(modulus, poisson));
  for (Body<OnePoint>* body : {&alone, &beside})
    body->place([](const Vector& x) { return bent(1.1 * x, 0.1); });
  for (int n = 0; n < 8; ++n) {
    const Vector x = bent(beside.position(n) / 1.1, 0.7);
    for (int k = 0; k < 3; ++k) beside.number<Position<ThreeD>>(n, k, 1) = x[k];
  }
  alone.find_forces();
  beside.find_forces();
  EXPECT_LT(beside.number<MinJacobian>(0, 0, 1), 0.3);
  EXPECT_EQ(beside.number<MinJacobian>(0), alone.number<MinJacobian>(0));
  for (int n = 0; n < 8; ++n)
    for (int k = 0; k < 3; ++k)
      EXPECT_EQ(beside.number<InternalForce<ThreeD>>(n, k),
                alone.number<InternalForce<ThreeD>>(n, k));
}

// Work of the internal forces on bending by one.
double bending_resistance(Body<OnePoint>& body) {
  double sum = 0;
  for (int n = 0; n < 8; ++n) {
    const Point& p = body.shape().nodes[std::size_t(n)];
    const Vector x(p[0], p[1], p[2]);
    sum -= body.force(n)[0] * sign_at(x, 0) * sign_at(x, 1);
  }
  return sum;
}
// The barrier's part of it.
double barrier_resistance(Body<OnePoint>& body) {
  const auto barrier = kernels::inversion_barrier(modes_of_body(body), body.shape().gauss[0],
                                                  body.shape().element[0], rigidity);
  return 8 * barrier.force[0].xe;
}

// Bending that flows bears no more than its limit up to where corners fold; the barrier bears any load.
TEST(InversionBarrier, BearsWhatFlowingBendingDoesNot) {
  Body<OnePoint> body(unit_cube(), material(modulus, poisson, 0.02));
  double without = 0, with = 0;
  for (double r = 1; r > 0.02; r -= 0.001) {
    body.place([&](const Vector& x) { return bent(x, bending_of_ratio(r)); });
    body.find_forces();
    with = bending_resistance(body);
    without = std::max(without, with - barrier_resistance(body));
  }
  EXPECT_LT(without, 0.03);
  EXPECT_GT(with, 10);
}

// Free to bend, under a dead load of three times what flowing bending bears; every step as long as the stable step allows.
TEST(InversionBarrier, KeepsACrushedElementFromFolding) {
  Body<OnePoint> body(unit_cube(), material(modulus, poisson, 0.02));
  const double load = 0.09, mass = body.number<Density>(0);
  double by = 0, speed = 0, least = 1;
  for (int step = 0; step < 2000; ++step) {
    body.place([&](const Vector& x) { return bent(x, by); });
    least = std::min(least, least_ratio_of(body));
    ASSERT_GT(least, 0) << step;
    body.find_forces();
    body.run<stable_time_step<OnePoint>>();
    const double dt = 0.9 * body.number<StableTimeStep>(0);
    speed = 0.98 * speed + dt / mass * (load - bending_resistance(body));
    by += dt * speed;
  }
  EXPECT_LT(least, 0.3);
  EXPECT_LT(std::abs(speed), 1e-9);
  EXPECT_NEAR(bending_resistance(body), load, 1e-6);
}

// A corner turned inside out is seen although the mean gradient has not changed.
TEST(InversionBarrier, FoldedCornersAreSeen) {
  Body<OnePoint> body(
      block({2, 1, 1}, [](const Vector& x) { return Vector(2 * x[0], x[1], x[2]); }),
      material(modulus, poisson));
  const int second = entry(body.shape().hexahedra[1], 1).value;
  body.find_forces();
  EXPECT_DOUBLE_EQ(body.number<MinJacobian>(0), 1);
  body.put(second, body.position(second) + Vector(-1.5, 0.6, 0.6));
  body.find_forces();
  EXPECT_LT(body.number<MinJacobian>(0), 0);
  EXPECT_EQ(body.number<WorstElement>(0), 1);
  body.world.emplace<Totals>();
  try {
    detail::Opener{body.world}.open<element_health>()();
    FAIL() << "a folded element goes on";
  } catch (const RunFailure& failure) {
    EXPECT_THAT(failure.what(),
                testing::StartsWith("element_health: particle 0, element 1: det F = -"));
  }
}

}  // namespace
}  // namespace pulvis::space
