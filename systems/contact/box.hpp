// Axis-aligned boxes of points.
#pragma once

#include <algorithm>
#include <array>

#include "components/dimension.hpp"

namespace pulvis {

template <class D>
struct BoxOf {
  std::array<double, D::axes> low, high;  // m

  typename D::Point middle() const {
    typename D::Point at;
    for (std::size_t k = 0; k < D::axes; ++k) at[k] = 0.5 * (low[k] + high[k]);
    return at;
  }
};
using Box = BoxOf<TwoD>;

// Of `count` points, whose coordinates follow each other.
template <class D>
BoxOf<D> box_of_points(const double* points, int count) {
  BoxOf<D> box;
  for (int k = 0; k < D::axes; ++k) {
    double low = points[k], high = points[k];
    for (int i = 1; i < count; ++i) {
      low = std::min(low, points[D::axes * i + k]);
      high = std::max(high, points[D::axes * i + k]);
    }
    box.low[k] = low;
    box.high[k] = high;
  }
  return box;
}
inline Box box_of(const double* points, int count) { return box_of_points<TwoD>(points, count); }

template <class D>
BoxOf<D> joined(BoxOf<D> a, const BoxOf<D>& b) {
  for (std::size_t k = 0; k < D::axes; ++k) {
    a.low[k] = std::min(a.low[k], b.low[k]);
    a.high[k] = std::max(a.high[k], b.high[k]);
  }
  return a;
}

template <class D>
bool near(const BoxOf<D>& a, const BoxOf<D>& b, double distance) {
  for (std::size_t k = 0; k < D::axes; ++k)
    if (a.low[k] > b.high[k] + distance || b.low[k] > a.high[k] + distance) return false;
  return true;
}

template <class D>
BoxOf<D> moved(BoxOf<D> box, const typename D::Point& by) {
  for (std::size_t k = 0; k < D::axes; ++k) {
    box.low[k] += by[k];
    box.high[k] += by[k];
  }
  return box;
}

}  // namespace pulvis
