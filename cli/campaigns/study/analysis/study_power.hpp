// How a value of the runs depends on a varied key: value = c key^exponent.
//
// exponent  d ln(value)/d ln(key), the relative sensitivity: by least squares of the logarithms over the runs, and at
//           each run from its neighbours
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/campaigns/study/analysis/study_spec.hpp"

namespace pulvis {

// Linear least squares of ln(y) against x; all points have equal weight.
struct LogLine {
  double at_zero = 0;    // y at x = 0
  double slope = 0;      // of ln(y)
  double r_squared = 0;  // of ln(y); NaN if all y are equal
};
LogLine fit_log_line(const std::vector<double>& x, const std::vector<double>& y);

struct PowerFit {
  double exponent = 0;
  double middle = 0;  // geometric mean of the key
  double value = 0;   // of the law at that key
  double r_squared = 0;
};
// Needs at least two different keys; all numbers > 0.
PowerFit fit_power(const std::vector<double>& key, const std::vector<double>& value);
// One per point, from the parabola of the logarithms through it and its neighbours, at the ends the line; keys increase.
std::vector<double> local_exponents(const std::vector<double>& key,
                                    const std::vector<double>& value);

// The SI unit of a key of the scene language; "-" where it has none.
std::string unit_of_key(const std::string& path);
// The same for what runs set, including variables of [let], which have the unit of their values.
std::string unit_of_varied(const std::vector<StudyRun>& runs, const std::string& path);
bool sets_key(const StudyRun& run, const std::string& path);
// What the run sets it to, in that unit; nothing if that is not a number or quantity.
std::optional<double> number_of_key(const StudyRun& run, const std::string& path);

}  // namespace pulvis
