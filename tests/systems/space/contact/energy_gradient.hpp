// Whether contact forces are the derivative of the energy stored in contacts and bonds.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/systems/space/contact/touching_bodies.hpp"

namespace pulvis::space {

inline double greatest_nodal_force(TouchingBodies& w) {
  double greatest = 0;
  for (int body = 0; body < static_cast<int>(w.bodies.size()); ++body)
    for (int n = 0; n < w.surface_nodes(body); ++n)
      greatest = std::max(greatest, w.force_on(body, n).norm());
  return greatest;
}

// Each node that carries a notable force is moved a little, along every axis.
inline void expect_gradient_of_energy(TouchingBodies& w) {
  w.update();
  const double greatest = greatest_nodal_force(w);
  ASSERT_GT(greatest, 0);
  int looked_at = 0;
  for (int body = 0; body < static_cast<int>(w.bodies.size()); ++body)
    for (int n = 0; n < w.surface_nodes(body); ++n) {
      const Vec3 force = w.force_on(body, n);
      if (force.norm() < 0.1 * greatest) continue;
      for (int k = 0; k < 3; ++k) {
        constexpr double h = 1e-7;  // 1e-4 of a face: E'' h^2 and round-off of E both below 1e-6
        const double x = w.node(body, n, k);
        w.node(body, n, k) = x + h;
        w.update();
        const double above = w.energy();
        w.node(body, n, k) = x - h;
        w.update();
        const double below = w.energy();
        w.node(body, n, k) = x;
        EXPECT_NEAR(-(above - below) / (2 * h), force[k], 1e-5 * greatest);
        ++looked_at;
      }
      w.update();
    }
  EXPECT_GE(looked_at, 30);
}

}  // namespace pulvis::space
