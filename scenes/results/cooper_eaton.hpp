// Least-squares fit of the sum a1 exp(-k1/P) + a2 exp(-k2/P) to given values.
//
// For given k1 and k2 the best a1 and a2 >= 0 follow in closed form, so only log k1 and log k2 are fitted
// (variable projection; Golub & Pereyra 1973): a coarse grid first, then Levenberg-Marquardt (Eigen) from
// its best points, because two exponentials have more than one local optimum. k stays between 1e-4 and 100
// times the largest pressure; beyond these a term is constant, or zero, within the measured pressures. Where the
// second term does not improve the fit (an a of 0, or k1 and k2 closer than 5%) one term is kept.
#pragma once

#include <array>
#include <cmath>
#include <vector>

namespace pulvis {

struct CooperEaton {
  int terms = 0;                   // 0: no fit found
  std::array<double, 2> a{}, k{};  // -, Pa; k[0] < k[1]
  std::array<bool, 2>
      is_k_at_bound{};  // the data give no value of k, only that it lies at or beyond its bound
  double at(double pressure) const {
    double sum = 0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(terms); ++i)
      sum += a[i] * std::exp(-k[i] / pressure);
    return sum;
  }
};

// All pressures > 0.
CooperEaton find_cooper_eaton(const std::vector<double>& pressure,
                              const std::vector<double>& value);

}  // namespace pulvis
