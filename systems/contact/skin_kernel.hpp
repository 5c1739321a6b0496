// How much of the skin two bodies have used up since the contact rows were built.
//
// Source   Verlet 1967 (neighbour lists), here by relative net displacement, so that neither common
//          motion nor vibration counts.
// Symbols  u   displacement of a surface point since then, m
//          D   smallest axis-aligned box that contains u of all control points of a body
// Law      Curves lie in the hull of their control points, surfaces in that of their Bezier points, so two points of bodies
//          a and b that were more than g apart along an axis cannot have met while closing(D_a, D_b) < g.
#pragma once

#include "systems/contact/box.hpp"

namespace pulvis::kernels {

// Largest distance between two boxes along an axis; < 0 where they overlap.
template <class D>
double gap(const BoxOf<D>& a, const BoxOf<D>& b) {
  double largest = -1e300;
  for (std::size_t k = 0; k < D::axes; ++k)
    largest = std::max({largest, a.low[k] - b.high[k], b.low[k] - a.high[k]});
  return largest;
}

// Upper bound on how much closer points with displacements in these boxes can have come along an axis.
template <class D>
double closing(const BoxOf<D>& a, const BoxOf<D>& b) {
  double maximum = 0;
  for (std::size_t k = 0; k < D::axes; ++k)
    maximum = std::max({maximum, a.high[k] - b.low[k], b.high[k] - a.low[k]});
  return maximum;
}

// Minimum of x . n over a box, and the largest displacement in a box against n.
template <class D>
double min_along(const BoxOf<D>& box, const typename D::Point& n) {
  double minimum = 0;
  for (std::size_t k = 0; k < D::axes; ++k)
    minimum += std::min(n[k] * box.low[k], n[k] * box.high[k]);
  return minimum;
}

}  // namespace pulvis::kernels
