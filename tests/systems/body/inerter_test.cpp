// The inerter between two nodes: no force in rigid motion, slower stretching, and the energy of it.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "systems/body/inerter_kernel.hpp"

namespace pulvis::kernels {
namespace {

using V = std::array<double, 3>;

// Turning about any axis at a constant rate: the distance does not change, so nothing acts.
TEST(Inerter, DoesNotActOnRigidMotion) {
  const V x{0.3, -0.2, 0.5}, omega{2, 1, -3};
  const auto cross = [](const V& a, const V& b) {
    return V{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  };
  const V v = cross(omega, x), a = cross(omega, v);
  EXPECT_NEAR(inerter_force(x, v, a, 1.0), 0, 1e-14);
  EXPECT_NEAR(inerter_energy(x, v, 1.0, 0.9), 0, 1e-15);
  EXPECT_LT(inerter_force(x, v, V{0, 0, 0}, 1.0), -1);  // free nodes would fly apart
}

// Two masses on a spring of stiffness k: omega^2 = k (1 - c) / mu. By leapfrog; the energy of masses, spring and inerter
// stays what it is.
TEST(Inerter, SlowsDownStretching) {
  constexpr double m1 = 2, m2 = 3, k = 5, rest = 1, c = 0.9;
  const double mu = reduced_mass(m1, m2), omega = std::sqrt(k * (1 - c) / mu), dt = 1e-3 / omega;
  double x1 = rest + 1e-3, x2 = 0, v1 = 0, v2 = 0;
  const auto force = [&] { return -k * (x1 - x2 - rest); };
  const double energy = 0.5 * k * 1e-6;
  double crossed = 0;
  for (int i = 1; crossed == 0; ++i) {
    const double f = force();
    const double pull =
        inerter_force(V{x1 - x2, 0, 0}, V{v1 - v2, 0, 0}, V{f / m1 + f / m2, 0, 0}, c * mu) *
        (x1 - x2);
    v1 += (f + pull) / m1 * dt;
    v2 -= (f + pull) / m2 * dt;
    x1 += v1 * dt;
    x2 += v2 * dt;
    if (x1 - x2 < rest) crossed = i * dt;
    const double kinetic = 0.5 * (m1 * v1 * v1 + m2 * v2 * v2) +
                           inerter_energy(V{x1 - x2, 0, 0}, V{v1 - v2, 0, 0}, mu, c);
    EXPECT_NEAR((kinetic + 0.5 * k * std::pow(x1 - x2 - rest, 2)) / energy, 1, 2e-3);
  }
  EXPECT_NEAR(crossed * omega, std::numbers::pi / 2, 3e-3);
  EXPECT_NEAR(m1 * v1 + m2 * v2, 0, 1e-15);
}

}  // namespace
}  // namespace pulvis::kernels
