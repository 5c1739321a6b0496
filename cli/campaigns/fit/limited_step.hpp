// The best step of a quadratic model, within bounds and within a region that can only be asked whether it allows a point.
//
// Model    q(u) = u'Hu/2 + g'u, H positive semidefinite; at most a few unknowns
// Bounds   the minimum lies on a face of the feasible polyhedron: all sets of at most n active limits are tried
// Region   if the minimum is not allowed, the region's border is found by bisection on rays from a point inside, and a
//          plane through it is added to the limits (Kelley 1960). Exact if the border is a plane, as for one
//          coefficient that must not exceed another
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <vector>

namespace pulvis {

struct QuadraticModel {
  Eigen::MatrixXd curvature;  // H
  Eigen::VectorXd slope;      // g

  double at(const Eigen::VectorXd& u) const { return 0.5 * u.dot(curvature * u) + slope.dot(u); }
};

struct HalfSpace {  // normal . u <= end
  Eigen::VectorXd normal;
  double end = 0;
};

// Minimum of the model within all limits; none if no point is.
std::optional<Eigen::VectorXd> minimum_within(const QuadraticModel& model,
                                              const std::vector<HalfSpace>& limits);

struct Region {
  std::function<bool(const Eigen::VectorXd&)> allows;
  Eigen::VectorXd inside;  // an allowed point, not on the border
  double accuracy = 0;     // distance to the border that does not matter
};

struct LimitedStep {
  Eigen::VectorXd to;
  bool is_best = true;  // false: an allowed point, but not known to be the minimum
  bool at_border = false;
};

LimitedStep limited_step(const QuadraticModel& model, std::vector<HalfSpace> limits,
                         const Region& region);

}  // namespace pulvis
