// Friction loops in volts of a known friction, sensitivity and adhesion.
#pragma once

#include <numbers>
#include <vector>

#include "scenes/lever/afm_loop.hpp"

namespace pulvis::wedge {

inline constexpr double degree = std::numbers::pi / 180;

struct Truth {
  double friction = 0.13, sensitivity = 240e-9;             // -, N/V
  double adhesion = 12e-9, crosstalk = 3e5, offset = 0.02;  // N, V/N, V

  Loop loop(double degrees, double load) const {
    const double a = degrees * degree;
    const double up = uphill(load, adhesion, friction, a);
    const double down = downhill(load, adhesion, friction, a);
    return {a,
            load,
            (up - down) / 2 / sensitivity,
            (up + down) / 2 / sensitivity + crosstalk * load + offset,
            {},
            {}};
  }
  std::vector<Loop> loops(const std::vector<double>& slopes,
                          const std::vector<double>& loads) const {
    std::vector<Loop> all;
    for (const double slope : slopes)
      for (const double load : loads) all.push_back(loop(slope, load));
    return all;
  }
};

inline const std::vector<double> loads{20e-9, 50e-9, 80e-9, 110e-9, 140e-9};

}  // namespace pulvis::wedge
