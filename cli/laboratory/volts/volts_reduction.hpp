// Combines the records of an AFM: force curves, loops, lever; then friction with its uncertainty.
#pragma once

#include <filesystem>
#include <vector>

#include "cli/laboratory/volts/force_curve.hpp"
#include "cli/laboratory/volts/monte_carlo.hpp"
#include "cli/laboratory/volts/volts_model.hpp"

namespace pulvis::volts {

struct CurveSet {
  std::filesystem::path file;
  std::vector<ForceCurve> curves;
  std::vector<CurveFigures> figures;  // of each curve
  Sensitivity mean;
};

struct WedgeLoops {
  std::filesystem::path file;  // empty: none
  WedgeKnown known;
  double skip = 0;
};

struct Reduced {
  CurveSet hard;
  std::optional<CurveSet> sample, side;
  Measured measured;
  std::vector<Input> inputs;
  std::vector<std::string> groups;
  MonteCarlo result;
  std::optional<wedge::Calibration> slopes;  // of the loops on slopes
  std::optional<MonteCarlo> other_root;      // the result with it, where the loops do not decide
};

// `folder`: that of the settings. Throws SceneError.
Reduced reduce(const VoltsSpec& spec, const WedgeLoops& wedge, const std::filesystem::path& folder,
               double confidence);

}  // namespace pulvis::volts
