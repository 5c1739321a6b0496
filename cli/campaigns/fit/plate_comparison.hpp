// Compares a simulated sliding-plate test with a measured one: over which range, how they differ there, and how
// uncertain the fitted values are.
//
// Compared  samples of the record (or coefficients) at distances covered by both: equal ones, or equal multiples of the
//           particle diameters
// Interval  (J'J)^-1 s^2 (1 + r)/(1 - r), s^2 the mean square of the residuals over n - p, r the correlation of
//           neighbouring ones; a stated uncertainty is used if it is larger. Student's distribution with n (1 - r)/(1 + r)
//           - p degrees of freedom; for coefficients alone, the normal one with their stated uncertainties. Infinite if
//           the residuals do not depend on a parameter, or the others can make up for its change
#pragma once

#include <Eigen/Dense>

#include "cli/campaigns/fit/plate_fit.hpp"
#include "cli/laboratory/lab_simulation.hpp"
#include "cli/laboratory/lab_uncertainty.hpp"

namespace pulvis {

class PlateComparison {
 public:
  // Reads the record; throws SceneError if it is not one.
  explicit PlateComparison(const PlateFit& fit);

  // The first simulated curve decides the range of comparison; refused if that has too few samples.
  void set_reach(const lab::SimulatedCurve& simulated);
  Eigen::VectorXd residuals(const lab::SimulatedCurve& simulated) const;

  bool has_record() const { return !fit_.spec.measured.record.empty(); }
  // The record on the simulation's distance scale.
  const std::vector<double>& distance() const { return distance_; }
  const std::vector<double>& friction() const { return friction_; }
  double from() const { return fit_.spec.measured.from; }
  double until() const { return until_; }
  std::size_t compared() const { return compared_.size(); }
  double simulated_diameter() const { return simulated_diameter_; }

  // What cannot be compared, and why, one sentence each.
  std::vector<std::string> limits() const;

  std::vector<lab::Measured> parameters(const std::vector<double>& values,
                                        const Eigen::VectorXd& residuals,
                                        const Eigen::MatrixXd& jacobian) const;

 private:
  void require_samples(double until);

  const PlateFit& fit_;
  double simulated_diameter_ = 0;         // m, mean diameter of the circles of equal area
  double measured_way_ = 0;               // m, as in the record
  double simulated_way_ = 0, until_ = 0;  // m
  std::vector<double> distance_, friction_;
  std::vector<std::size_t> compared_;  // samples of the record
};

// The maximum friction within a distance, and the mean over distance from a given one on.
double static_coefficient(const lab::SimulatedCurve& curve, double within);
double dynamic_coefficient(const lab::SimulatedCurve& curve, double from);

}  // namespace pulvis
