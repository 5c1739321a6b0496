// Laws of powder compaction fitted to a curve of punch pressure against relative density.
//
// Sources   Heckel (1961): ln[1/(1 - D)] = K P + A, yield pressure 1/K
//           Kawakita & Luedde (1971): P/C = P/a + 1/(a b), C = (V0 - V)/V0
//           Cooper & Eaton (1962): (V0 - V)/(V0 - Vinf) = a1 exp(-k1/P) + a2 exp(-k2/P)
// D is the relative density, P the axial pressure on the punch, V the volume of the compact, V0 at the
// first sample, Vinf at D = 1; with no mass lost C = 1 - D0/D and (V0 - V)/(V0 - Vinf) = C/(1 - D0).
//
// Range     the loading: samples up to the largest density. Of these only those count whose pressure is
//           at least 1% of the largest one of the loading (below that the punch is not in contact yet) and
//           whose density is below 1. All samples weigh the same; Heckel and Kawakita are straight lines
//           by least squares in the coordinates above, Cooper-Eaton is fitted to its left side.
// A curve outside the scope of a law is not fitted, and the reason is kept.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace pulvis {

struct FitParameter {
  std::string name, unit;
  double value = 0;
  bool is_at_bound = false;  // of its search: the curve does not determine it
};

struct DensityFit {
  std::string law;         // "heckel"
  std::string not_fitted;  // why; empty: it was fitted
  std::vector<FitParameter> parameters;
  double rms = 0;                 // of the fitted quantity, in its unit
  std::string rms_unit;           // "-" or "Pa"
  double r_squared = 0;           // of the fitted quantity
  double rms_density = 0;         // of the density from the law at each pressure: compares the laws
  std::vector<double> densities;  // that the law gives at FitRange::pressure; for plotting
};

struct FitRange {
  double first_density = 0;               // D0
  std::vector<double> density, pressure;  // of the samples that count
  std::string unusable;                   // why nothing can be fitted; empty: it can
};

inline constexpr std::size_t fewest_fit_samples = 8;
inline constexpr double min_density_change = 1e-3;
inline constexpr double min_pressure_share = 0.01;  // of the largest

// From a whole history; pressure in Pa, compression > 0.
FitRange fit_range(std::span<const double> density, std::span<const double> pressure);

// From a loading that was already extracted, samples with low <= pressure <= high.
FitRange range_between(double first_density, std::span<const double> density,
                       std::span<const double> pressure, double low, double high);

DensityFit fit_heckel(const FitRange& range);
DensityFit fit_kawakita(const FitRange& range);
DensityFit fit_cooper_eaton(const FitRange& range);
std::vector<DensityFit> fit_all(const FitRange& range);  // in the order above

}  // namespace pulvis
