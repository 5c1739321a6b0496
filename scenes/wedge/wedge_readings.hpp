// The loops of a wedge calibration, slope by slope: means at one load, or least-squares lines over several loads.
#pragma once

#include <vector>

#include "scenes/wedge/wedge_calibration.hpp"

namespace pulvis::wedge {

inline double squared(double x) { return x * x; }

struct Fit {
  Value slope, zero;  // per unit load; at zero load
  Value middle;       // at the mean load, where its error is independent of that of the slope
  double load = 0;    // N, the mean

  double at(double other) const { return middle.value + slope.value * (other - load); }
};

// The loops of one slope.
struct Reading {
  Facet facet;
  double load = 0;  // N, where there is only one
  Fit offset;       // where there are several loads

  bool is_single() const { return facet.loads == 1; }
};

// In the order of the slopes. Throws std::runtime_error with what is wrong and what is allowed.
std::vector<Reading> readings_of(const std::vector<Loop>& loops);

}  // namespace pulvis::wedge
