// Isotropic hardening: growth of the flow stress with accumulated plastic strain.
//
// Law      a struct with the initial yield stress sigma_y [Pa], and for numbers and lanes
//            flow_stress(eps)   Pa, non-decreasing
//            modulus(eps)       Pa, its slope; infinite where the curve starts vertically
//            plastic_work(eps)  J/m^3, its integral from 0
//          and its keyword in scenes, `name`. A new law is one more struct and HardeningLaw entry.
// Source   Voce (1948); Swift (1952); Ludwik (1909)
// Symbols  eps  accumulated plastic strain [-], >= 0
#pragma once

#include <algorithm>
#include <variant>
#include <vector>

#include "systems/laws/elementary.hpp"

namespace pulvis::kernels {

// sigma_y + H eps; H = 0: perfectly plastic. The return map uses its closed form.
template <class T>
struct LinearHardening {
  static constexpr const char* name = "linear";
  T sigma_y, H;
  T flow_stress(T eps) const { return fma(H, eps, sigma_y); }
  T modulus(T) const { return H; }
  T plastic_work(T eps) const { return eps * (sigma_y + 0.5 * H * eps); }
};

// sigma_y + Q (1 - e^(-b eps)): saturates.
struct VoceHardening {
  static constexpr const char* name = "voce";
  double sigma_y = 0;
  double Q = 0;  // Pa, total increase
  double b = 0;  // -, 1/b is the strain at which 63% of it is reached
  template <class T>
  T flow_stress(T eps) const {
    return sigma_y + Q * (1.0 - exponential(-b * eps));
  }
  template <class T>
  T modulus(T eps) const {
    return Q * b * exponential(-b * eps);
  }
  template <class T>
  T plastic_work(T eps) const {
    return sigma_y * eps + Q * (eps - (1.0 - exponential(-b * eps)) / b);
  }
};

// K (eps_0 + eps)^n with K eps_0^n = sigma_y.
struct SwiftHardening {
  static constexpr const char* name = "swift";
  double sigma_y = 0;
  double eps_0 = 0;  // -
  double n = 0;      // -
  template <class T>
  T flow_stress(T eps) const {
    return sigma_y * power(1.0 + eps / eps_0, n);
  }
  template <class T>
  T modulus(T eps) const {
    return (sigma_y * n / eps_0) * power(1.0 + eps / eps_0, n - 1);
  }
  template <class T>
  T plastic_work(T eps) const {
    return (sigma_y * eps_0 / (n + 1)) * (power(1.0 + eps / eps_0, n + 1) - 1.0);
  }
};

// sigma_y + K eps^n (the A + B eps^n of Johnson and Cook): vertical at eps = 0 if n < 1.
struct LudwikHardening {
  static constexpr const char* name = "ludwik";
  double sigma_y = 0;
  double K = 0;  // Pa
  double n = 0;  // -
  template <class T>
  T flow_stress(T eps) const {
    return sigma_y + K * power(eps, n);
  }
  template <class T>
  T modulus(T eps) const {
    return (K * n) * power(eps, n - 1);
  }
  template <class T>
  T plastic_work(T eps) const {
    return sigma_y * eps + (K / (n + 1)) * power(eps, n + 1);
  }
};

// Piecewise linear between points, the first at eps = 0; constant stress beyond the last one.
struct TabulatedHardening {
  static constexpr const char* name = "table";
  double sigma_y = 0;            // the first stress
  std::vector<double> eps = {};  // -, increasing
  std::vector<double> stress = {};
  std::vector<double> work = {};  // J/m^3, up to each point

  TabulatedHardening() = default;
  TabulatedHardening(std::vector<double> strains, std::vector<double> stresses)
      : sigma_y(stresses.front()), eps(std::move(strains)), stress(std::move(stresses)) {
    work.push_back(0);
    for (std::size_t i = 1; i < eps.size(); ++i)
      work.push_back(work.back() + 0.5 * (stress[i - 1] + stress[i]) * (eps[i] - eps[i - 1]));
  }
  template <class T>
  T flow_stress(T at) const {
    return each_number(at, [&](double x) {
      const std::size_t i = before(x);
      return stress[i] + slope(i) * (x - eps[i]);
    });
  }
  template <class T>
  T modulus(T at) const {
    return each_number(at, [&](double x) { return slope(before(x)); });
  }
  template <class T>
  T plastic_work(T at) const {
    return each_number(at, [&](double x) {
      const std::size_t i = before(x);
      const double more = x - eps[i];
      return work[i] + more * (stress[i] + 0.5 * slope(i) * more);
    });
  }

 private:
  std::size_t before(double x) const {  // the last point at or before x
    const auto after = std::upper_bound(eps.begin() + 1, eps.end(), x);
    return static_cast<std::size_t>(after - eps.begin()) - 1;
  }
  double slope(std::size_t i) const {
    return i + 1 < eps.size() ? (stress[i + 1] - stress[i]) / (eps[i + 1] - eps[i]) : 0;
  }
};

using HardeningLaw = std::variant<LinearHardening<double>, VoceHardening, SwiftHardening,
                                  LudwikHardening, TabulatedHardening>;

}  // namespace pulvis::kernels
