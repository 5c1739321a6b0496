// Reduction of sliding-plate tests from raw records to friction curves, values and repeatability.
//
//   records -> sliding (LVDT) -> one clock -> forces -> friction coefficient -> values -> over the runs
//
// Curve    samples of the logger from the start of sliding to its end; the press's force and
//          displacement are interpolated between its samples
// Static   the largest coefficient within analysis.static_within of the start, a single sample
// Dynamic  the mean over distance (trapezoidal rule) from analysis.dynamic_from on, interpolated
//          at the ends of the window
// Trend    slope of the straight line through the same part, per metre
#pragma once

#include "cli/laboratory/lab_clock.hpp"
#include "cli/laboratory/lab_stick_slip.hpp"
#include "scenes/solve/lab_statistics.hpp"

#include <optional>
#include <string>
#include <vector>

namespace pulvis::lab {

struct Curve {                       // one value per sample
  std::vector<double> time;          // s, since the start of sliding, on the logger's clock
  std::vector<double> distance;      // m
  std::vector<double> shear_force;   // N
  std::vector<double> punch_force;   // N
  std::vector<double> punch_travel;  // m, since the start of sliding, into the die
  std::vector<double> length;        // m, of the compact
  std::vector<double> target_force;  // N, transmitted to the target
  std::vector<double> friction;      // -
};

struct Static {
  double value = 0, distance = 0;  // -, m
  bool is_distinct = false;        // above the dynamic mean by more than stick-slip and noise
};

struct Dynamic {
  double mean = 0, deviation = 0;  // -, of the samples
  double trend = 0;                // 1/m
  double from = 0, until = 0;      // m
};

struct ReducedRun {
  std::string name;
  std::filesystem::path press, logger;
  Clocks clocks;
  bool has_end = false;   // the plate stopped within the record
  double speed = 0;       // m/s, mean
  double shear_zero = 0;  // N, subtracted from the calibrated shear force
  double noise = 0;       // -, of the coefficient, from the load cell at standstill
  Curve curve;
  Static peak;
  Dynamic dynamic;
  std::optional<double> elastic_dynamic;  // -, where K is given: value for an elastic compact's K
  std::optional<StickSlip> stick_slip;
};

struct RunFiles {
  std::string name;
  std::filesystem::path press, logger;
  std::optional<double> offset;
};

ReducedRun reduce(const PressRecord& press, const LoggerRecord& logger, const Settings& settings,
                  const RunFiles& run);

// The values of an existing curve; `noise` as in ReducedRun.
Static static_peak(const Curve& curve, double within);
Dynamic dynamic_mean(const Curve& curve, const AnalysisSpec& spec);

// A curve on the grid 0, step, 2 step, ... up to its end: linear between samples that move on.
std::vector<double> on_grid(const std::vector<double>& distance, const std::vector<double>& values,
                            double step);

struct Repeatability {
  Sample peak, dynamic, amplitude, period;  // the last two over the runs with stick-slip
  std::vector<Sample> friction;             // on the grid, up to the end of the shortest run
};

Repeatability repeatability(const std::vector<ReducedRun>& runs, double step);

}  // namespace pulvis::lab
