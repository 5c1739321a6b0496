// Weibull's law of strength, P(s) = 1 - exp(-(s/scale)^modulus), fitted by maximum likelihood.
//
// Sources   Weibull (1951); estimates, their bias and their confidence limits as in Thoman, Bain & Antle (1969) and
//           ASTM C1239
// Estimates several samples may share a modulus, as weakest-link theory implies for bodies of several sizes. With n
//           strengths in a sample, x = ln s and w = exp(modulus x), modulus and scales solve
//             sum over samples of n (1/modulus + mean x - sum(w x)/sum w) = 0,   scale^modulus = mean w
//           The left side decreases with the modulus: the solution is unique unless all strengths of a sample are equal.
// Limits    with hats on estimates, modulus^/modulus and modulus^ ln(scale^/scale) have distributions that depend only on
//           the numbers of strengths (they are pivotal), and so has every weighted sum of the second, such as the
//           exponent of a size effect. They are sampled by Monte Carlo, with a fixed seed.
#pragma once

#include <vector>

namespace pulvis {

struct Estimate {
  double value = 0;
  double low = 0, high = 0;  // two-sided limits of 90% confidence
};

struct WeibullFit {
  Estimate modulus;              // -, maximum likelihood
  double unbiased_modulus = 0;   // divided by the mean of modulus^/modulus
  std::vector<Estimate> scales;  // in the unit of the strengths, one per sample
  Estimate exponent;  // of scale ~ size^exponent, by least squares of ln(scale); if sizes are given
};

inline constexpr int default_draws = 10'000;

// Every sample has at least two different strengths, all > 0; sizes, one per sample, not all equal. Without draws there
// are neither limits nor an unbiased modulus.
WeibullFit fit_weibull(const std::vector<std::vector<double>>& samples, int draws = default_draws,
                       const std::vector<double>& sizes = {});

// Probability of failure assigned to strength `rank` (from 0) of `count` sorted ones.
inline double failure_probability(std::size_t rank, std::size_t count) {
  return (static_cast<double>(rank) + 0.5) / static_cast<double>(count);
}

}  // namespace pulvis
