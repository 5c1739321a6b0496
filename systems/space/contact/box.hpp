// Axis-aligned boxes, and how far their contents have approached each other.
//
// Source   systems/contact/skin_kernel.hpp, in three dimensions
#pragma once

#include <algorithm>
#include <array>

#include "components/space/contact.hpp"

namespace pulvis::space {

struct Box {
  std::array<double, 3> low, high;

  Point middle() const {
    return {0.5 * (low[0] + high[0]), 0.5 * (low[1] + high[1]), 0.5 * (low[2] + high[2])};
  }
};

inline Box joined(const Box& a, const Box& b) {
  Box box = a;
  for (std::size_t k = 0; k < 3; ++k) {
    box.low[k] = std::min(a.low[k], b.low[k]);
    box.high[k] = std::max(a.high[k], b.high[k]);
  }
  return box;
}

// Of the Bezier points of a face, whose hull contains the face (convex hull property).
inline Box face_box(const PatchNumbers& face) {
  Box box{};
  for (int k = 0; k < 3; ++k) {
    double &low = entry(box.low, k), &high = entry(box.high, k);
    low = high = face(k, 0);
    for (int p = 1; p < patch_points; ++p) {
      low = std::min(low, face(k, p));
      high = std::max(high, face(k, p));
    }
  }
  return box;
}

inline bool near(const Box& a, const Box& b, double distance) {
  for (std::size_t k = 0; k < 3; ++k)
    if (a.low[k] > b.high[k] + distance || b.low[k] > a.high[k] + distance) return false;
  return true;
}

inline Box moved(Box box, const Point& by) {
  for (std::size_t k = 0; k < 3; ++k) {
    box.low[k] += by[k];
    box.high[k] += by[k];
  }
  return box;
}

namespace kernels {

// Largest distance between two boxes along any axis; < 0 if they overlap.
inline double gap(const Box& a, const Box& b) {
  double largest = -1e300;
  for (std::size_t k = 0; k < 3; ++k)
    largest = std::max({largest, a.low[k] - b.high[k], b.low[k] - a.high[k]});
  return largest;
}

// Upper bound on the approach along any axis of points whose displacements lie in these boxes.
inline double closing(const Box& a, const Box& b) {
  double maximum = 0;
  for (std::size_t k = 0; k < 3; ++k)
    maximum = std::max({maximum, a.high[k] - b.low[k], b.high[k] - a.low[k]});
  return maximum;
}

// Minimum x . n over a box.
inline double min_along(const Box& box, const Point& n) {
  double minimum = 0;
  for (std::size_t k = 0; k < 3; ++k) minimum += std::min(n[k] * box.low[k], n[k] * box.high[k]);
  return minimum;
}

}  // namespace kernels
}  // namespace pulvis::space
