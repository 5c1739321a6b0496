// A force curve in volts: the slope of its contact part, the pull-off, and what the lateral signal shows of it.
//
// Axes     d displacement of the piezo towards the surface, 0 at the start; V volts of the normal signal, growing
//          when the probe is pressed on
// Free     a line through the samples with d below a share of that of the turning point, of each way its own:
//          interference and drift are taken off with it; y is what is left of V
// Contact  a line through the samples with y between two shares of the greatest, of each way. Their mean slope
//          is the deflection sensitivity S, V/m; F = k_n y/S. Error: that of the lines (neighbours may hang
//          together), and half the difference of both ways over sqrt(3) (piezo hysteresis, friction)
// Pull-off the line through the last samples under the tension, taken half a step beyond the last of them: the
//          smallest sample alone would be too small by noise. No pull-off where none is below five times the noise
// Work     the area under the line of no force on the way back, in V m
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scenes/lever/lab_fit.hpp"

namespace pulvis::volts {

struct ForceCurve {
  std::string name;
  std::vector<double> displacement;  // m, from the start
  std::vector<double> normal;        // V
  std::vector<double> lateral;       // V; empty: not recorded
  std::size_t turn = 0;              // the sample that is farthest from the start
};

struct CurveWindow {
  double free = 0, from = 0, until = 0;
  bool needs_return = true;  // both ways; otherwise the way there alone will do
};

struct Way {
  lab::Line free, contact;    // contact: of y
  double slope_error = 0;     // V/m, that of the line of no force included
  double free_inflation = 1;  // of the free line's errors: neighbours hang together
  double curvature = 0;  // -, slope of the contact's upper half over that of the lower one, less 1
};

struct CurveFigures {
  Way approach;
  std::optional<Way> retract;
  lab::Mean sensitivity;              // V/m
  double noise = 0;                   // V, about the free line
  lab::Mean pull_off;                 // V, >= 0
  std::optional<double> pull_off_at;  // m
  double work = 0;                    // V m
  std::optional<lab::Mean> crosstalk;
};

// Throws std::runtime_error with what is wrong and what is allowed.
CurveFigures figures_of(const ForceCurve& curve, const CurveWindow& window);

struct Sensitivity {
  lab::Mean slope;                     // V/m
  lab::Mean pull_off;                  // V
  std::optional<lab::Mean> crosstalk;  // where all curves have a lateral signal
};

// Means over curves: the error is the larger of the curves' own and of their scatter (wider where they are few), and
// what both ways differ by.
Sensitivity mean_over(const std::vector<CurveFigures>& curves);

}  // namespace pulvis::volts
