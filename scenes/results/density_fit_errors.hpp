// How sure the parameters of a fitted law are, from the scatter of the samples about it.
//
// Source   White (1980): the covariance of a least-squares fit whose residuals scatter unequally,
//            (J'J)^-1 J' diag(e^2) J (J'J)^-1
//          Neighbouring residuals that follow each other (a law that bends otherwise than the curve) tell less than
//          independent ones: n of them with the correlation r of neighbours count as n (1 - r)/(1 + r).
// Symbols  e residuals of the fitted ordinate, J its derivatives by the parameters, n samples
#pragma once

#include <vector>

#include "scenes/results/density_fits.hpp"

namespace pulvis {

struct FitErrors {
  std::vector<double> standard;  // of each of DensityFit::parameters, in its unit
  double freedom = 0;            // independent samples less fitted parameters; at least 1
};

// `fit` is of `range`, and fitted.
FitErrors fit_errors(const DensityFit& fit, const FitRange& range);

}  // namespace pulvis
