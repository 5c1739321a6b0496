// A force curve in volts: the slope of its contact part, the pull-off, and the crosstalk in the lateral signal.
//
// Axes     d displacement of the piezo towards the surface, 0 at the start; V volts of the normal signal, increasing
//          when the probe is pressed on
// Free     a line through the samples with d below a share of that of the turning point, separately for approach and
//          retraction: it removes interference and drift; y is the remainder of V
// Contact  a line through the samples with y between two shares of the maximum, for each direction. Their mean slope
//          is the deflection sensitivity S, V/m; F = k_n y/S. Error: that of the lines (neighbours may be
//          correlated), and half the difference of both directions over sqrt(3) (piezo hysteresis, friction)
// Pull-off the line through the last samples in tension, evaluated half a step beyond the last of them: the
//          smallest sample alone would be biased by noise. No pull-off if none is below five times the noise
// Work     the area below the line of zero force on retraction, in V m
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scenes/solve/lab_fit.hpp"

namespace pulvis::volts {

struct ForceCurve {
  std::string name;
  std::vector<double> displacement;  // m, from the start
  std::vector<double> normal;        // V
  std::vector<double> lateral;       // V; empty: not recorded
  std::size_t turn = 0;              // index of the sample farthest from the start
};

struct CurveWindow {
  double free = 0, from = 0, until = 0;
  bool needs_return = true;  // both directions; otherwise the approach alone is enough
};

struct Way {
  lab::Line free, contact;    // contact: of y
  double slope_error = 0;     // V/m, including that of the line of zero force
  double free_inflation = 1;  // of the free line's errors: neighbours are correlated
  double curvature = 0;  // -, slope of the contact's upper half over that of the lower one, minus 1
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

// Means over curves: the error is the larger of the curves' errors and of their scatter (wider where they are few),
// combined with the difference of both directions.
Sensitivity mean_over(const std::vector<CurveFigures>& curves);

}  // namespace pulvis::volts
