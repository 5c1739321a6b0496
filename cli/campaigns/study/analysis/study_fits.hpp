// Strength laws, and power laws of values, fitted across the runs of a study.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/campaigns/study/analysis/study_spec.hpp"
#include "cli/campaigns/study/analysis/study_trends.hpp"

namespace pulvis {

struct FitRuns {  // fitted together
  std::string name;
  std::vector<const StudyRun*> runs;
};

// For Weibull's law one per variation; for Ryshkewitch and Duckworth's by the values of `by`, or all runs; for a power
// law the runs that set its key, by their scene and their other settings.
std::vector<FitRuns> groups_of(const Study& study, const StudyFit& fit);
std::size_t fewest_runs(StudyFit::Law law);  // per group

// m, of a class of discs; nothing if there is none of that name, or its outline is not a disc.
std::optional<double> disc_diameter(const Scene& scene, const std::string& particle);

struct FittedPoint {
  const StudyRun* run = nullptr;
  double strength = 0;             // in FittedLaw::unit
  double failure_probability = 0;  // Weibull
  double porosity = 0;             // Ryshkewitch and Duckworth
  double key = 0;                  // power law, in FittedLaw::key_unit
  double local_exponent = 0;
};

struct FittedParameter {
  std::string name, unit;
  double value = 0;
  std::optional<double> low, high;  // limits of 90% confidence
};

struct FittedGroup {
  std::string name;
  std::string not_fitted;           // why not; empty: it is fitted
  std::optional<double> diameter;   // m, of the disc, if all runs have the same
  std::vector<FittedPoint> points;  // by increasing strength, porosity or key
  std::vector<FittedParameter> parameters;
};

struct FittedLaw {
  const StudyFit* fit = nullptr;
  std::string law;  // "weibull"
  std::string title;
  std::string unit;  // of the strengths, or of the power law's values
  std::string key_unit;
  std::vector<FittedGroup> groups;
  // Weakest-link theory, if there are discs of different sizes: the modulus shared by all groups, the
  // exponent -2/modulus of scale against diameter that follows, and the exponent that was found.
  std::vector<FittedParameter> size_effect;
};

std::vector<FittedLaw> fit_study(const Study& study, const SeriesOfRun& series,
                                 const FailureOfRun& failed);

// One verdict per group, for laws whose exponent has bounds.
std::vector<Verdict> judge_fits(const std::vector<FittedLaw>& laws);

}  // namespace pulvis
