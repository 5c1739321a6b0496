// How much of the skin two bodies have used up since the contact rows were built.
//
// Source   Verlet 1967 (neighbour lists), here by relative net displacement, so that neither common
//          motion nor vibration counts.
// Symbols  u   displacement of a surface point since then, m
//          D   smallest axis-aligned box that contains u of all control points of a body
// Law      Curves lie in the hull of their control points, so two points of bodies a and b that were more
//          than g apart along an axis cannot have met while closing(D_a, D_b) < g.
#pragma once

#include <algorithm>
#include <array>

#include "engine/entry.hpp"
#include "systems/contact/broad_phase.hpp"

namespace pulvis::kernels {

// Largest distance between two boxes along an axis; < 0 where they overlap.
inline double gap(const Box& a, const Box& b) {
  double largest = -1e300;
  for (int k = 0; k < 2; ++k)
    largest = std::max({largest, a.low[k] - b.high[k], b.low[k] - a.high[k]});
  return largest;
}

// Upper bound on how much closer points with displacements in these boxes can have come along an axis.
inline double closing(const Box& a, const Box& b) {
  double maximum = 0;
  for (int k = 0; k < 2; ++k)
    maximum = std::max({maximum, a.high[k] - b.low[k], b.high[k] - a.low[k]});
  return maximum;
}

// Minimum of x . n over a box, and the largest displacement in a box against n.
inline double min_along(const Box& box, const std::array<double, 2>& n) {
  double minimum = 0;
  for (int k = 0; k < 2; ++k) {
    const double component = entry(n, k);
    minimum += std::min(component * box.low[k], component * box.high[k]);
  }
  return minimum;
}

inline Box moved(Box box, const std::array<double, 2>& by) {
  for (int k = 0; k < 2; ++k) {
    box.low[k] += entry(by, k);
    box.high[k] += entry(by, k);
  }
  return box;
}

}  // namespace pulvis::kernels
