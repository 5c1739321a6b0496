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
  const auto turning = inerter(x, v, a, 1.0);
  EXPECT_NEAR(inerter_force(turning), 0, 1e-14);
  EXPECT_NEAR(inerter_energy(x, v, v, 1.0, 0.9), 0, 1e-15);
  EXPECT_LT(inerter_force(inerter(x, v, V{0, 0, 0}, 1.0)), -1);  // free nodes would fly apart
  for (const double f : inerter_forces(turning, turning, 0.3)) EXPECT_NEAR(f, 0, 1e-13);
}

// Two masses on a spring of stiffness k: omega^2 = k (1 - c) / mu. By leapfrog; the energy of masses, spring and inerter
// stays what it is.
TEST(Inerter, SlowsDownStretching) {
  constexpr double m1 = 2, m2 = 3, k = 5, rest = 1, c = 0.9;
  const double mu = m1 * m2 / (m1 + m2), omega = std::sqrt(k * (1 - c) / mu), dt = 1e-3 / omega;
  double x1 = rest + 1e-3, x2 = 0, v1 = 0, v2 = 0;
  const auto force = [&] { return -k * (x1 - x2 - rest); };
  const double energy = 0.5 * k * 1e-6;
  double crossed = 0;
  for (int i = 1; crossed == 0; ++i) {
    const double f = force();
    const double pull = inerter_force(inerter(V{x1 - x2, 0, 0}, V{v1 - v2, 0, 0},
                                              V{f / m1 + f / m2, 0, 0}, c * mu)) *
                        (x1 - x2);
    v1 += (f + pull) / m1 * dt;
    v2 -= (f + pull) / m2 * dt;
    x1 += v1 * dt;
    x2 += v2 * dt;
    if (x1 - x2 < rest) crossed = i * dt;
    const double kinetic =
        0.5 * (m1 * v1 * v1 + m2 * v2 * v2) +
        inerter_energy(V{x1 - x2, 0, 0}, V{v1 - v2, 0, 0}, V{v1 - v2, 0, 0}, mu, c);
    EXPECT_NEAR((kinetic + 0.5 * k * std::pow(x1 - x2 - rest, 2)) / energy, 1, 2e-3);
  }
  EXPECT_NEAR(crossed * omega, std::numbers::pi / 2, 3e-3);
  EXPECT_NEAR(m1 * v1 + m2 * v2, 0, 1e-15);
}

// Three masses in a bent chain: the forces are those for which each equals -b d2L/dt2, with the accelerations that all of them
// cause; they add up to nothing, and have no moment.
TEST(Inerter, SharesANodeWithAnother) {
  constexpr std::array<double, 3> m{2, 3, 5};
  const std::array<V, 3> x{{{0.1, 1.1, 0}, {0, 0, 0.2}, {-0.3, -1.2, 0.1}}},
      v{{{0.5, -1, 2}, {0, 1, -1}, {0.3, 0.2, 0.4}}}, f{{{1, 2, 3}, {-2, 0, 1}, {0, 5, -1}}};
  constexpr double c = 0.9;
  const auto apart = [](const std::array<V, 3>& of, std::size_t link) {
    V d;
    for (std::size_t k = 0; k < 3; ++k) d[k] = of[link][k] - of[link + 1][k];
    return d;
  };
  const auto accelerations = [&](const std::array<V, 3>& forces) {
    std::array<V, 3> a;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < 3; ++k) a[i][k] = forces[i][k] / m[i];
    return a;
  };
  const auto reduced = [&](std::size_t link) {
    return m[link] * m[link + 1] / (m[link] + m[link + 1]);
  };
  const auto of = [&](const std::array<V, 3>& a, std::size_t link) {
    return inerter(apart(x, link), apart(v, link), apart(a, link), c * reduced(link));
  };
  const auto bare = accelerations(f);
  const auto pull = inerter_forces(of(bare, 0), of(bare, 1), dot(apart(x, 0), apart(x, 1)) / m[1]);
  std::array<V, 3> with = f;
  for (std::size_t link = 0; link < 2; ++link)
    for (std::size_t k = 0; k < 3; ++k) {
      with[link][k] += pull[link] * apart(x, link)[k];
      with[link + 1][k] -= pull[link] * apart(x, link)[k];
    }
  const auto a = accelerations(with);
  for (std::size_t link = 0; link < 2; ++link) {
    const V d = apart(x, link), w = apart(v, link);
    const double L = std::sqrt(dot(d, d)), rate = dot(d, w) / L,
                 second = (dot(d, apart(a, link)) + dot(w, w) - rate * rate) / L;
    const double b = reduced(link) * c / (1 - c);
    EXPECT_NEAR(pull[link] * L, -b * second, 1e-12) << link;
  }
}

// Four masses in a bent ring: the same.
TEST(Inerter, FormsARing) {
  constexpr std::array<double, 4> m{1, 2, 4, 3};
  constexpr double c = 0.9;
  const std::array<V, 4> x{{{0, 0, 0.1}, {1, 0.2, 0}, {1.2, 0.9, -0.2}, {-0.1, 1.1, 0}}},
      v{{{0.5, -1, 2}, {0, 1, -1}, {0.3, 0.2, 0.4}, {-1, 0, 1}}},
      f{{{1, 2, 3}, {-2, 0, 1}, {0, 5, -1}, {2, -2, 1}}};
  const auto apart = [](const std::array<V, 4>& of, std::size_t link) {
    V d;
    for (std::size_t k = 0; k < 3; ++k) d[k] = of[link][k] - of[(link + 1) % 4][k];
    return d;
  };
  const auto accelerations = [&](const std::array<V, 4>& forces) {
    std::array<V, 4> a;
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t k = 0; k < 3; ++k) a[i][k] = forces[i][k] / m[i];
    return a;
  };
  const auto reduced = [&](std::size_t link) {
    const double next = m[(link + 1) % 4];
    return m[link] * next / (m[link] + next);
  };
  const auto bare = accelerations(f);
  std::array<Inerter<double>, 4> of;
  std::array<double, 4> coupling;
  for (std::size_t i = 0; i < 4; ++i) {
    of[i] = inerter(apart(x, i), apart(v, i), apart(bare, i), c * reduced(i));
    coupling[i] = dot(apart(x, (i + 3) % 4), apart(x, i)) / m[i];
  }
  const auto pull = inerter_ring_forces(of, coupling);
  std::array<V, 4> with = f;
  for (std::size_t link = 0; link < 4; ++link)
    for (std::size_t k = 0; k < 3; ++k) {
      with[link][k] += pull[link] * apart(x, link)[k];
      with[(link + 1) % 4][k] -= pull[link] * apart(x, link)[k];
    }
  const auto a = accelerations(with);
  for (std::size_t link = 0; link < 4; ++link) {
    const V d = apart(x, link), w = apart(v, link);
    const double L = std::sqrt(dot(d, d)), rate = dot(d, w) / L,
                 second = (dot(d, apart(a, link)) + dot(w, w) - rate * rate) / L;
    EXPECT_NEAR(pull[link] * L, -reduced(link) * c / (1 - c) * second, 1e-12) << link;
  }
}

}  // namespace
}  // namespace pulvis::kernels
