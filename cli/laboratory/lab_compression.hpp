// Reduction of compression curves: the laws of Heckel, Kawakita and Cooper and Eaton fitted to the loading with
// confidence intervals, and comparison with a simulation.
//
// Interval  scatter of the samples about the law (scenes/results/density_fit_errors.hpp), and the effect of one
//           standard uncertainty of height, mass, compliance, the fit to the empty press and, with `final_height`, the noise
//           of the last sample: the curve is reduced and fitted again with each
// Misfit    over the densities that both loadings cover, at evenly spaced densities: mean and root mean square of
//           ln(P_simulated/P_measured); and of the density at equal pressures
#pragma once

#include <filesystem>

#include "cli/laboratory/lab_press.hpp"
#include "cli/laboratory/lab_uncertainty.hpp"
#include "scenes/results/density_fits.hpp"
#include "scenes/solve/lab_statistics.hpp"

namespace pulvis::lab {

struct LawFit {
  DensityFit fit;                    // with the reason where it is not fitted
  std::vector<Measured> parameters;  // in the order of the fit's parameters
};

struct ReducedCurve {
  std::string name;
  std::filesystem::path press;
  PressCurve curve;
  std::optional<Unloading> unloading;
  FitRange range;
  std::vector<LawFit> laws;
};

ReducedCurve reduce_curve(const PressRecord& record, const CurveSpec& spec,
                          const Settings& settings, const Compliance& machine);

// A parameter of one law over all curves that have it.
struct OverCurves {
  std::string law, name, unit;
  Sample sample;
};
std::vector<OverCurves> over_curves(const std::vector<ReducedCurve>& curves);

struct SimulatedCompression {
  std::string name;
  std::vector<double> density,
      pressure;  // of the loading, up to the largest density; density increases
};

SimulatedCompression read_compression(const std::filesystem::path& run_folder,
                                      const SimulationSpec& spec);

struct CompressionMisfit {
  std::string simulation, curve;
  std::string not_compared;                       // why; empty: it was compared
  double from = 0, until = 0;                     // -, densities
  double log_pressure = 0, rms_log_pressure = 0;  // -
  double rms_density = 0;                         // -
};

CompressionMisfit misfit_of(const SimulatedCompression& simulated, const ReducedCurve& measured);

}  // namespace pulvis::lab
