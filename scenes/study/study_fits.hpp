// Laws of strength, and power laws of values, fitted across the runs of a study.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scenes/study/study.hpp"
#include "scenes/study/study_trends.hpp"

namespace pulvis {

struct FitRuns {  // that are fitted together
  std::string name;
  std::vector<const StudyRun*> runs;
};

// One a variation for Weibull's law; for Ryshkewitch and Duckworth's by the values of `by`, or all runs; for a power law
// those runs that set its key, by their scene and by what else they set.
std::vector<FitRuns> groups_of(const Study& study, const StudyFit& fit);
std::size_t fewest_runs(StudyFit::Law law);  // of a group

// m, of a class of discs; nothing where there is none of that name, or its outline is another.
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
  std::string not_fitted;           // why; empty: it is fitted
  std::optional<double> diameter;   // m, of the disc, where all runs have the same
  std::vector<FittedPoint> points;  // by rising strength, porosity or key
  std::vector<FittedParameter> parameters;
};

struct FittedLaw {
  const StudyFit* fit = nullptr;
  std::string law;  // "weibull"
  std::string title;
  std::string unit;  // of the strengths, or of what the power law is of
  std::string key_unit;
  std::vector<FittedGroup> groups;
  // The weakest link, where there are discs of different sizes: the modulus that all groups have in common, the
  // exponent -2/modulus of scale against diameter that follows, and the one that was found.
  std::vector<FittedParameter> size_effect;
};

std::vector<FittedLaw> fit_study(const Study& study, const SeriesOfRun& series,
                                 const FailureOfRun& failed);

// One verdict a group, of the laws whose exponent has bounds.
std::vector<Verdict> judge_fits(const std::vector<FittedLaw>& laws);

}  // namespace pulvis
