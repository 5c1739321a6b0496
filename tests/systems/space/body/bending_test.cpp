// Bending, twisting and shapes that keep their volume: bodies in three dimensions against beams and spheres.
#include <gtest/gtest.h>

#include "tests/systems/space/body/relaxation.hpp"

namespace pulvis::space {
namespace {

template <class F>
class Bending : public testing::Test {};
TYPED_TEST_SUITE(Bending, Formulations);

constexpr double bar_modulus = 1, bar_span = 10;

Shape bar(std::array<int, 3> n, double lean) {
  return block(n, [&](const Vector& x) {
    return Vector(bar_span * x[0] + lean * (x[1] - 0.5), x[1] - 0.5, x[2] - 0.5);
  });
}
bool is_root(const Vector& x) { return x[0] < 1e-9; }
bool is_tip(const Vector& x) { return x[0] > bar_span - 1e-9; }

// What a small force on the tip moves, over Timoshenko's beam: P l^3/(3 E I) + P l/(5/6 G A).
template <class F>
double tip_deflection(std::array<int, 3> n, double nu) {
  Body<F> body(bar(n, 0), material(bar_modulus, nu));
  const double force = 1e-6;
  const int tips = (n[1] + 1) * (n[2] + 1);
  const Displacements u = small_displacements(
      body, [](const Vector& x, int) { return is_root(x); },
      [&](const Vector& x) { return is_tip(x) ? Vector(0, 0, force / tips) : Vector(0, 0, 0); });
  double deflection = 0;
  for (int i = 0; i < body.nodes(); ++i)
    if (is_tip(body.position(i))) deflection += u(3 * i + 2) / tips;
  const double shear = bar_modulus / (2 * (1 + nu));
  return deflection /
         (force * (std::pow(bar_span, 3) / (3 * bar_modulus / 12) + bar_span / (5.0 / 6 * shear)));
}

// One element through the thickness, ten along the beam, also where volume is kept. (The root is clamped and cannot
// grow thicker, which stiffens the beam by a percent or two.) Eight points lock in shear here, and are not asked.
TEST(BendingOfOnePoint, CantileverOfOneElementInThickness) {
  EXPECT_NEAR(tip_deflection<OnePoint>({10, 1, 1}, 0), 1, 0.005);
  EXPECT_NEAR(tip_deflection<OnePoint>({10, 1, 1}, 0.3), 1, 0.02);
  EXPECT_NEAR(tip_deflection<OnePoint>({10, 1, 1}, 0.499), 1, 0.03);
}

TYPED_TEST(Bending, CantileverOfTwoElementsInThickness) {
  EXPECT_NEAR(tip_deflection<TypeParam>({20, 2, 2}, 0.3), 1, 0.03);
  EXPECT_NEAR(tip_deflection<TypeParam>({20, 2, 2}, 0.499), 1, 0.06);
}

// Bent by fibre forces on both ends: elements that lean by `lean` over a width of one. Curvature over M/(E I).
template <class F>
double pure_bending(double lean, int plane, double nu) {
  Body<F> body(block({6, 1, 1},
                     [&](const Vector& x) {
                       const double u = x[0], shear = lean * u * (1 - u) * 4;  // straight ends
                       return Vector(bar_span * u + shear * (x[std::size_t(plane)] - 0.5),
                                     x[1] - 0.5, x[2] - 0.5);
                     }),
               material(bar_modulus, nu));
  const double moment = 1e-6;
  const Displacements v = small_displacements(
      body,
      [&](const Vector& x, int k) {
        if (k == 0) return is_root(x);
        return is_root(x) && x[1] < 0 && x[2] < 0;
      },
      [&](const Vector& x) {
        return is_tip(x) ? Vector(moment * x[2] / (4 * 0.25), 0, 0) : Vector(0, 0, 0);
      });
  double turn = 0;
  for (int i = 0; i < body.nodes(); ++i)
    if (is_tip(body.position(i))) turn += v(3 * i) * body.position(i)[2];
  return turn / (moment * bar_span / (bar_modulus / 12));
}

// Exact in boxes and in parallelepipeds, near it in others: across the plane of bending and in it.
TEST(BendingOfOnePoint, PureBendingOfLeaningElements) {
  for (const int plane : {1, 2}) {
    EXPECT_NEAR(pure_bending<OnePoint>(0, plane, 0.3), 1, 1e-6);
    EXPECT_NEAR(pure_bending<OnePoint>(0.3, plane, 0.3), 1, 2e-3);
    EXPECT_NEAR(pure_bending<OnePoint>(1, plane, 0.3), 1, 1e-2);
  }
}

// Twist of a square bar of edge one over T l/(G J), J = 0.1406.
template <class F>
double twist(int n, double nu) {
  Body<F> body(bar({10, n, n}, 0), material(bar_modulus, nu));
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
  const double shear = bar_modulus / (2 * (1 + nu));
  return (turn_at(7) - turn_at(3)) * shear * 0.1406 / (torque * 4);
}
// One element cannot warp: J is the polar moment, 1/6. More come near from the stiff side.
TYPED_TEST(Bending, TwistOfASquareBar) {
  EXPECT_NEAR(twist<TypeParam>(1, 0.3), 0.1406 * 6, 1e-3);
  EXPECT_NEAR(twist<TypeParam>(4, 0.3), 1, 0.06);
}

// ---- plastic limits ---------------------------------------------------------------------------------------
// Moment of a bar of `n` elements through its thickness over sigma_y b h^2/4, bent to `far` times first yield by the
// turn of its ends.
template <class F>
double limit_moment(int n, double far) {
  constexpr double yield = 0.002, bar_length = 4;
  Body<F> body(block({4, n, n},
                     [&](const Vector& x) {
                       return Vector(bar_length * (x[0] - 0.5), x[1] - 0.5, x[2] - 0.5);
                     }),
               material(bar_modulus, 0.3, yield));
  const auto is_end = [&](int i) {
    const Point& p = body.shape().nodes[std::size_t(i)];
    return std::abs(p[0]) > bar_length / 2 - 1e-9;
  };
  const double last = far * yield / bar_modulus / 0.5 * bar_length / 2;  // angle of an end
  move_slowly(body, 6000, [&](int i, double share, Vector& x, Vector& v) {
    if (!is_end(i)) return;
    const Point& p = body.shape().nodes[std::size_t(i)];
    x[0] = p[0] + (p[0] > 0 ? 1 : -1) * last * share * p[2];
    v[0] = 0;
  });
  double moment = 0;
  for (int i = 0; i < body.nodes(); ++i)
    if (is_end(i)) moment += 0.5 * std::abs(body.force(i)[0] * body.position(i)[2]);
  return moment / (yield / 4);
}

// One element: the moment of the section. Of several, those that are stretched bear besides what the joint surface leaves of
// their own bending: at most a part of sqrt(5/4) - 1 for two, falling with the square of their number.
TEST(BendingOfOnePoint, BarReachesItsLimitMoment) {
  EXPECT_NEAR(limit_moment<OnePoint>(1, 8), 1, 0.01);
  EXPECT_NEAR(limit_moment<OnePoint>(2, 8), std::sqrt(1.25), 0.01);
  EXPECT_NEAR(limit_moment<OnePoint>(4, 8), 1.02, 0.03);
}

// A thick sphere under pressure, as a thin pyramid of it whose nodes move along the radius: p = 2 sigma_y ln(b/a) when
// all of it flows, which keeps its volume.
template <class F>
double sphere_pressure(int n, double nu) {
  constexpr double yield = 0.002, inner = 1, outer = 2, half_width = 0.25;
  const auto direction = [&](double u, double v) {
    return Vector(Vector(half_width * (2 * u - 1), half_width * (2 * v - 1), 1).normalized());
  };
  Body<F> body(block({1, 1, n},
                     [&](const Vector& x) {
                       return Vector((inner + (outer - inner) * x[2]) * direction(x[0], x[1]));
                     }),
               material(bar_modulus, nu, yield));
  const double solid = 3 * body.shape().volume / (std::pow(outer, 3) - std::pow(inner, 3));
  constexpr double radius = 1.04 * inner;
  move_slowly(body, 8000, [&](int i, double share, Vector& x, Vector& v) {
    const Point& p = body.shape().nodes[std::size_t(i)];
    const Vector d = Vector(p[0], p[1], p[2]).normalized();
    x = (i < 4 ? inner + share * (radius - inner) : x.dot(d)) * d;
    v = i < 4 ? Vector(0, 0, 0) : Vector(v.dot(d) * d);
  });
  double force = 0, rim = 0;
  for (int i = 0; i < 4; ++i) force -= body.force(i).dot(body.position(i).normalized());
  rim = body.position(body.nodes() - 1).norm();
  return force / (solid * radius * radius) / (2 * yield * std::log(rim / radius));
}

// (The damping of the motion bears a per cent of it.)
TYPED_TEST(Bending, ThickSphereReachesItsLimitPressure) {
  EXPECT_NEAR(sphere_pressure<TypeParam>(8, 0.3), 1, 0.025);
  EXPECT_NEAR(sphere_pressure<TypeParam>(8, 0.49), 1, 0.05);
}

}  // namespace
}  // namespace pulvis::space
