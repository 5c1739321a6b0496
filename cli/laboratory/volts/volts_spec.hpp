// From an AFM's volts to the friction coefficient of a sample: what is needed besides the records. Declared in
// declare_volts.cpp.
#pragma once

#include <optional>
#include <string>

namespace pulvis::volts {

enum class LateralMethod { wedge, test_probe };
enum class CrosstalkMethod { force_curves, given, none };

struct AfmSpec {
  std::string loops;  // file, relative to the settings' folder; empty: this evaluation is skipped
  LateralMethod lateral = LateralMethod::wedge;
  double level_error = 0;  // V
  int draws = 0;
  int seed = 0;
};

struct ForceCurvesSpec {
  std::string hard,
      sample;  // files; sample empty: adhesion is taken from the curves on the hard surface
  double piezo_error = 0;      // -
  double free = 0;             // -, of the displacement to the turning point
  double from = 0, until = 0;  // -, of the largest signal
};

struct LeverSpec {
  std::string calibration;          // summary.json of a run; empty: the numbers below
  std::optional<double> k_n;        // N/m
  std::optional<double> k_n_error;  // -
  std::optional<double> tilt;       // rad
  std::optional<double> k_l;        // N/m
  std::optional<double> k_l_error;  // -
  std::optional<double> arm;        // m
  double arm_error = 0;             // -
  std::optional<double> twist_share;
};

struct CrosstalkSpec {
  CrosstalkMethod method = CrosstalkMethod::force_curves;
  double coefficient = 0, error = 0;
};

struct TestProbeSpec {
  std::string contacts;       // file
  std::optional<double> arm;  // m
  double arm_error = 0;       // -
  double twist_share = 0;
  double intensity_ratio = 0, intensity_error = 0;  // -
  double piezo_error = 0;
};

struct VoltsSpec {
  AfmSpec afm;
  ForceCurvesSpec force_curves;
  LeverSpec lever;
  CrosstalkSpec crosstalk;
  TestProbeSpec test_probe;

  bool wanted() const { return !afm.loops.empty(); }
  LateralMethod lateral() const { return afm.lateral; }
};

}  // namespace pulvis::volts
