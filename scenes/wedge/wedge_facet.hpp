// Friction and sensitivity of one slope of a wedge calibration, with its uncertainty, at either root or at the double
// root between them (scenes/wedge/wedge_calibration.hpp).
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

#include "scenes/wedge/wedge_calibration.hpp"

namespace pulvis::wedge {

struct Pair {
  double friction = 0, sensitivity = 0;
};

// Volts per load; `adhesion` over the load, 0 where the volts are slopes over several loads.
struct PerLoad {
  double width = 0, offset = 0, adhesion = 0, slope = 0;

  Pair at(double friction) const {
    return {friction, half_width(1, adhesion, friction, slope) / width};
  }
  std::optional<Pair> solved(Root root) const;  // empty where there is none, or the tip locks
  double double_root() const;
  // Delta/W over its smallest value, less one: m + 1/m = 2 (1 + excess), with m = mu/double_root.
  double excess() const;
};

// The signal of a flat facet at the loads of an inclined one, to be subtracted. Its errors are common to all
// facets: those of the flat facet's slope over the loads (or of its only load) and of its value at the mean load.
struct Level {
  double by_load = 0;  // V/N
  std::array<double, 2> errors{};
  bool errors_known = true;
  double tilt = 0;  // rad, standard uncertainty of the flat facet's slope
};

// What is solved for friction and sensitivity.
struct Signals {
  Value half_width, offset;  // V/N, the offset without the flat facet's
  Value adhesion;            // over the load; 0 where the volts are slopes over several loads
  double slope = 0;          // rad
  // The half-width is a slope over several loads, but the offset that of the flat facet's only load.
  bool is_mixed = false;

  std::array<double, 4> values() const {
    return {half_width.value, offset.value, slope, adhesion.value};
  }
  PerLoad at(const std::array<double, 4>& x) const;
};

// A facet's figure, its error without those common to all facets, and those: of its level, and of how level the
// flat facet is.
struct Estimate {
  Value own;
  Eigen::Vector3d common = Eigen::Vector3d::Zero();
  double by_offset = 0;  // derivative with respect to the offset
  bool errors_known = true;
};

struct FacetEstimates {
  Estimate friction, sensitivity;
  bool is_double = false;  // cannot be told from the double root
};

class FacetCalibration {
 public:
  FacetCalibration(const Signals& signals, const Level& level, double slope_error);

  // Delta/W is within three of its standard uncertainties, with those common to all facets, of its smallest value.
  bool is_double() const;
  // Its standard uncertainty reaches both roots, and as far as one beyond them: with m the coefficient over the
  // double root, (m - 1)^2 is about 2 excess.
  FacetEstimates at_double_root() const;
  // Throws std::runtime_error where there is none, or the tip would lock.
  FacetEstimates at_root(Root root) const;

 private:
  double excess_error() const;
  void propagate(Estimate& estimate, Root root, double Pair::*figure) const;

  const Signals& signals_;
  const Level& level_;
  std::array<double, 4> at_;
  std::array<double, 4> errors_{};
  bool errors_known_ = false;
};

}  // namespace pulvis::wedge
