// Output files of a fit: fit.json, trials.csv, report.html.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

#include "cli/campaigns/fit/gauss_newton.hpp"
#include "cli/campaigns/fit/plate_comparison.hpp"

namespace pulvis {

struct FitTrial {
  std::vector<double> values;
  std::string run;    // its folder
  double misfit = 0;  // root mean square of the residuals
  lab::SimulatedCurve curve;
};

struct FitResult {
  const PlateFit& fit;
  const PlateComparison& comparison;
  const GaussNewton& search;
  std::vector<FitTrial> trials;
  std::vector<lab::Measured> parameters;
  std::vector<std::string> warnings;

  const FitTrial& best() const;
};

void write_fit(const std::filesystem::path& folder, const FitResult& result);
std::string fit_text(const FitResult& result);

}  // namespace pulvis
