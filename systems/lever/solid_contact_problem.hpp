// The contact of a probe whose solid answers linearly: forces on its points, and the target's height where
// a servo moves it. Dense and small; the solid enters by its compliance alone.
//
// Source   the law of probe_contact_kernel.hpp at every point, with places
//            x = x_0 + S (f - f_0) - Z e_z,   sum f_z = set point (servo)
//          by Newton's method in f and Z: 3 unknowns a point and one for the servo
// Symbols  S [3 points, 3 points] m/N, symmetric; Z rise of the target, m
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "systems/lever/probe_contact_kernel.hpp"
#include "systems/lever/solid_bundles.hpp"

namespace pulvis {

struct ContactPoint {
  kernels::ProbeLaw law;
  Eigen::Vector3d place, before;          // m, in the target's frame: now, at the last equilibrium
  Eigen::Vector3d force, old_tangential;  // N, now, at the last equilibrium
  bool touched = false;                   // then
};

struct ContactProblem {
  const TargetShape* shape = nullptr;
  double end_radius = 0;
  std::vector<ContactPoint> points;
  Eigen::MatrixXd compliance;
  std::optional<double> set_point;  // N
  bool may_jump = false;  // where no equilibrium is near, to the next one that damping leads to
};

struct ContactAnswer {
  bool converged = false;
  Eigen::VectorXd force;  // [3 points] N
  double height = 0;      // m
  int iterations = 0;
  double released = 0;  // J, of a jump
};

ContactAnswer solve_contact(const ContactProblem& problem);

// Of a point that came to `place`, the other things as they are.
kernels::ProbePlace place_on(const TargetShape& shape, const ContactPoint& point, double end_radius,
                             const Eigen::Vector3d& place);

// On the target, in the order of sums that keeps the digits of a displacement: a stiff probe's forces depend
// on a billionth of it.
Eigen::Vector3d place_from(const Target& target, const Eigen::Vector3d& reference,
                           const Eigen::Vector3d& displacement);

// Of the node that a point is.
Eigen::Vector3d probe_place(int node, const Configuration& configuration, const Target& target);

ContactPoint contact_point(Row<ProbePoint> row, const Eigen::Vector3d& place, const Target& target,
                           const Probe& probe);

}  // namespace pulvis
