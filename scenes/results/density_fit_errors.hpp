// Uncertainty of the parameters of a fitted law, from the scatter of the samples about it.
//
// Source   White (1980): the covariance of a least-squares fit with heteroscedastic residuals,
//            (J'J)^-1 J' diag(e^2) J (J'J)^-1
//          Correlated neighbouring residuals (a law that curves unlike the data) carry less information than
//          independent ones: n of them with the correlation r of neighbours count as n (1 - r)/(1 + r).
// Symbols  e residuals of the fitted ordinate, J its derivatives by the parameters, n samples
#pragma once

#include <vector>

#include "scenes/results/density_fits.hpp"

namespace pulvis {

struct FitErrors {
  std::vector<double> standard;  // for each of DensityFit::parameters, in its unit
  double freedom = 0;            // independent samples minus fitted parameters; at least 1
};

// `fit` is a successful fit to `range`.
FitErrors fit_errors(const DensityFit& fit, const FitRange& range);

}  // namespace pulvis
