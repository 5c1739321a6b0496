// The contact of a probe on a linearised solid: forces on its points, and the target's height if a servo
// moves it. Dense and small; the solid enters only through its compliance.
//
// Source   the law of probe_contact_kernel.hpp at every point, with positions
//            x = x_0 + S (f - f_0) - Z e_z,   sum f_z = set point (servo)
//          by Newton's method in f and Z: 3 unknowns per point and one for the servo
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
  bool touched = false;                   // at the last equilibrium
};

struct ContactProblem {
  const TargetShape* shape = nullptr;
  double end_radius = 0;
  std::vector<ContactPoint> points;
  Eigen::MatrixXd compliance;
  std::optional<double> set_point;  // N
  bool may_jump = false;  // if no equilibrium is nearby, to the next one that damping leads to
};

struct ContactAnswer {
  bool converged = false;
  Eigen::VectorXd force;  // [3 points] N
  double height = 0;      // m
  int iterations = 0;
  double released = 0;  // J, by a jump
};

ContactAnswer solve_contact(const ContactProblem& problem);

// For a point that moved to `place`, everything else unchanged.
kernels::ProbePlace place_on(const TargetShape& shape, const ContactPoint& point, double end_radius,
                             const Eigen::Vector3d& place);

// In the target's frame, summed in the order that keeps the digits of a displacement: the forces of a stiff
// probe depend on a billionth of it.
Eigen::Vector3d place_from(const Target& target, const Eigen::Vector3d& reference,
                           const Eigen::Vector3d& displacement);

// Position of the node of a probe point.
Eigen::Vector3d probe_place(int node, const Configuration& configuration, const Target& target);

ContactPoint contact_point(Row<ProbePoint> row, const Eigen::Vector3d& place, const Target& target,
                           const Probe& probe);

}  // namespace pulvis
