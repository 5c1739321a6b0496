// Winding number of an outline around a point, from how a ray from the point crosses its chords.
//
// Law      the winding number of a closed chain around q is the sum over a ray from q of +1 where it leaves, -1
//          where it enters (material to the left of the chain): 1 in a body, 0 outside, 2 where the body overlaps itself
// Symbols  q   start of the ray, m;   d   its direction;   a, b   ends of a chord, in the order of the outline
#pragma once

#include <array>

namespace pulvis::kernels {

inline int crossing(const std::array<double, 2>& q, const std::array<double, 2>& d,
                    const std::array<double, 2>& a, const std::array<double, 2>& b) {
  const double ax = a[0] - q[0], ay = a[1] - q[1], bx = b[0] - q[0], by = b[1] - q[1];
  const double side_a = d[0] * ay - d[1] * ax, side_b = d[0] * by - d[1] * bx;
  if ((side_a > 0) == (side_b > 0)) return 0;
  const double share = side_a / (side_a - side_b);
  const double ahead = d[0] * (ax + share * (bx - ax)) + d[1] * (ay + share * (by - ay));
  return ahead > 0 ? (side_b > 0 ? 1 : -1) : 0;
}

}  // namespace pulvis::kernels
