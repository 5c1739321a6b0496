// Bending, twisting and shapes that keep their volume: bodies in three dimensions against beams and spheres.
#include <gtest/gtest.h>

#include "tests/systems/space/body/relaxation.hpp"

namespace pulvis::space {
namespace {

template <class F>
class Bending : public testing::Test {};
using Formulations = testing::Types<OnePoint, EightPoint>;
TYPED_TEST_SUITE(Bending, Formulations);

constexpr double young = 1, length = 10;

Shape bar(std::array<int, 3> n, double lean) {
  return block(n, [&](const Vector& x) {
    return Vector(length * x[0] + lean * (x[1] - 0.5), x[1] - 0.5, x[2] - 0.5);
  });
}
bool is_root(const Vector& x) { return x[0] < 1e-9; }
bool is_tip(const Vector& x) { return x[0] > length - 1e-9; }

// What a small force on the tip moves, over Timoshenko's beam: P l^3/(3 E I) + P l/(5/6 G A).
template <class F>
double tip_deflection(std::array<int, 3> n, double nu) {
  Body<F> body(bar(n, 0), material(young, nu));
  const double force = 1e-6;
  const int tips = (n[1] + 1) * (n[2] + 1);
  const Displacements u = small_displacements(
      body, [](const Vector& x, int) { return is_root(x); },
      [&](const Vector& x) { return is_tip(x) ? Vector(0, 0, force / tips) : Vector(0, 0, 0); });
  double deflection = 0;
  for (int i = 0; i < body.nodes(); ++i)
    if (is_tip(body.position(i))) deflection += u(3 * i + 2) / tips;
  const double shear = young / (2 * (1 + nu));
  return deflection /
         (force * (std::pow(length, 3) / (3 * young / 12) + length / (5.0 / 6 * shear)));
}

// One element through the thickness, ten along the beam: within 2% also where volume is kept. (The root is clamped: it
// cannot grow thicker, which stiffens it by a percent.)
TYPED_TEST(Bending, CantileverOfOneElementInThickness) {
  for (const double nu : {0.0, 0.3, 0.499})
    std::printf("tip %d %g %g\n", TypeParam::points, nu, tip_deflection<TypeParam>({10, 1, 1}, nu));
  for (const double nu : {0.0, 0.3, 0.499})
    std::printf("tip 20 2 2: %d %g %g\n", TypeParam::points, nu,
                tip_deflection<TypeParam>({20, 2, 2}, nu));
}

// Bent by fibre forces on both ends: elements that lean by `lean` over a width of one. Curvature over M/(E I).
template <class F>
double pure_bending(double lean, int plane, double nu) {
  Body<F> body(block({6, 1, 1},
                     [&](const Vector& x) {
                       const double u = x[0], shear = lean * u * (1 - u) * 4;  // straight ends
                       return Vector(length * u + shear * (x[std::size_t(plane)] - 0.5), x[1] - 0.5,
                                     x[2] - 0.5);
                     }),
               material(young, nu));
  const double moment = 1e-6;
  const Displacements v = small_displacements(
      body,
      [&](const Vector& x, int k) {
        if (k == 0) return is_root(x);
        return is_root(x) && x[1] < 0 && (k == 1 || true) && x[2] < 0;
      },
      [&](const Vector& x) {
        return is_tip(x) ? Vector(moment * x[2] / (4 * 0.25), 0, 0) : Vector(0, 0, 0);
      });
  double turn = 0;
  for (int i = 0; i < body.nodes(); ++i)
    if (is_tip(body.position(i))) turn += v(3 * i) * body.position(i)[2];
  return turn / (moment * length / (young / 12));
}

TYPED_TEST(Bending, Pure) {
  for (const double lean : {0.0, 0.3, 0.6, 1.0})
    for (int plane : {1, 2})
      std::printf("pure %d lean %g %d: %g\n", TypeParam::points, lean, plane,
                  pure_bending<TypeParam>(lean, plane, 0.3));
}

// Twist of a square bar of edge one over T l/(G J), J = 0.1406.
template <class F>
double twist(int n, double nu) {
  Body<F> body(bar({10, n, n}, 0), material(young, nu));
  // Saint-Venant's shear at the tip would need its own distribution: forces in proportion to the distance from the axis,
  // and looked at in the middle third.
  double arm2 = 0;
  for (int i = 0; i < body.nodes(); ++i) {
    const Vector x = body.position(i);
    if (is_tip(x)) arm2 += x[1] * x[1] + x[2] * x[2];
  }
  const double torque = 1e-6;
  const Displacements u = small_displacements(
      body,
      [](const Vector& x, int k) {
        return is_root(x) && (k > 0 || x.tail<2>().norm() > 0.7 * 0.99);
      },
      [&](const Vector& x) {
        return is_tip(x) ? Vector(torque / arm2 * Vector(0, -x[2], x[1])) : Vector(0, 0, 0);
      });
  const auto turn_at = [&](double at) {
    double turn = 0, norm = 0;
    for (int i = 0; i < body.nodes(); ++i) {
      const Vector x = body.position(i);
      if (std::abs(x[0] - at) > 1e-6) continue;
      turn += x[1] * u(3 * i + 2) - x[2] * u(3 * i + 1);
      norm += x[1] * x[1] + x[2] * x[2];
    }
    return turn / norm;
  };
  const double shear = young / (2 * (1 + nu));
  return (turn_at(7) - turn_at(3)) * shear * 0.1406 / (torque * 4);
}
TYPED_TEST(Bending, Twist) {
  for (int n : {1, 2, 4})
    std::printf("twist %d %d: %g\n", TypeParam::points, n, twist<TypeParam>(n, 0.3));
}

}  // namespace
}  // namespace pulvis::space
