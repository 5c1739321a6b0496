// A test matrix: sliding-plate tests at different load, roughness, direction, speed and powder, reduced to a mean with
// its interval for each condition, and to the effect of each factor.
//
// Model     y = m + sum over the factors of the effect of its level; the effects of a factor sum to zero over its levels
// Source    Montgomery, Design and Analysis of Experiments: general linear model by effect coding; a factor is tested by
//           the loss in the sum of squares without it (type III), the model by its lack of fit against the scatter of
//           repeated runs (chapters 5 and 11)
// Variance  pure error: scatter of runs of the same condition, over all conditions; without replicates that of the
//           residuals of the model, which then also contains interactions
// Interval  Student's distribution with the degrees of freedom of that variance
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/laboratory/lab_settings.hpp"
#include "scenes/solve/lab_statistics.hpp"

namespace pulvis::lab {

struct Factor {
  std::string name;                 // "load", "roughness", ...
  std::vector<std::string> levels;  // as text, in ascending numerical order or order of appearance
  std::vector<std::size_t> of_run;  // level of each run
};

// Those that all runs state; constant ones have one level.
std::vector<Factor> factors_of(const std::vector<RunSpec>& runs);

struct Condition {
  std::vector<std::size_t> levels;  // one per factor
  std::vector<std::size_t> runs;
};
std::vector<Condition> conditions_of(const std::vector<Factor>& factors);

struct Effect {
  std::string factor, level;
  double value = 0;
  std::optional<double> half_width;
};

struct FactorTest {
  std::string factor;  // "interactions": the lack of fit
  double f = 0;
  int freedom = 0;         // degrees of freedom of the numerator
  double probability = 1;  // p-value: of this F or a larger one, if there were no effect
};

struct Effects {
  std::string not_found;  // why; empty: they were found
  double mean = 0;
  std::optional<double> mean_half_width;
  std::vector<Effect> effects;
  std::vector<FactorTest> tests;
  double deviation = 0;  // standard deviation of one run
  int freedom = 0;       // its degrees of freedom
  bool is_pure_error = false;
};

Effects effects_of(const std::vector<Factor>& factors, const std::vector<Condition>& conditions,
                   const std::vector<double>& values, double confidence);

}  // namespace pulvis::lab
