// Area between four tools, of which the bottom one may have grooves: reference of the relative density.
//
// Law      width times height, minus the integral of the bottom surface over the width (exact: straight
//          pieces)
#pragma once

#include <algorithm>
#include <cstddef>

#include "components/relief.hpp"

namespace pulvis::kernels {

// Integral of the surface height from its first x to `x`, m^2.
inline double relief_volume(const Relief& relief, double x) {
  const std::size_t last = relief.x.size() - 1;
  if (x <= relief.x.front()) return (x - relief.x.front()) * relief.y.front();
  if (x >= relief.x.back()) return relief.volume[last] + (x - relief.x.back()) * relief.y.back();
  const auto above = std::upper_bound(relief.x.begin(), relief.x.end(), x);
  const auto i = static_cast<std::size_t>(above - relief.x.begin()) - 1;
  const double share = (x - relief.x[i]) / (relief.x[i + 1] - relief.x[i]);
  const double height = relief.y[i] + share * (relief.y[i + 1] - relief.y[i]);
  return relief.volume[i] + 0.5 * (relief.y[i] + height) * (x - relief.x[i]);
}

struct DieSides {  // m
  double left, right, top;
  double bottom_x, bottom_y;  // position of the bottom tool
};

inline double die_area(const DieSides& at, const Relief& bottom) {
  const double box = (at.right - at.left) * (at.top - at.bottom_y);
  if (bottom.x.empty()) return box;
  return box - (relief_volume(bottom, at.right - at.bottom_x) -
                relief_volume(bottom, at.left - at.bottom_x));
}

}  // namespace pulvis::kernels
