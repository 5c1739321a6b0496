// Single quads for the tests of the element kernels.
#pragma once

#include <array>

#include "tests/helpers/random_values.hpp"

namespace pulvis::kernels {

using Coordinates = std::array<double, 8>;  // x0 y0 x1 y1 ...

inline QuadMap<double> map_of(const Coordinates& x) {
  return quad_map(x[0], x[1], x[2], x[3], x[4], x[5], x[6], x[7]);
}

inline Coordinates distorted_square(Random& random) {
  Coordinates x{-1, -1, 1, -1, 1, 1, -1, 1};
  for (double& v : x) v += random.in(-0.3, 0.3);
  return x;
}

// x as f takes it, and somewhere else.
inline Coordinates moved(const Coordinates& x, const Matrix2<double>& f) {
  Coordinates to{};
  for (std::size_t i = 0; i < 8; i += 2) {
    to[i] = f.xx * x[i] + f.xy * x[i + 1] + 3.0;
    to[i + 1] = f.yx * x[i] + f.yy * x[i + 1] - 2.0;
  }
  return to;
}

}  // namespace pulvis::kernels
