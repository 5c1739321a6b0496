// One point of a probe against a rigid target: force and tangent.
//
// Source   penalty and Coulomb's law with a return map: Simo & Laursen (1992); adhesion as a constant
//          pull-off force in contact (Derjaguin, Muller & Toporov 1975) that fades outside as 1/(1+g/r)^2
// Symbols  g gap, m, < 0 in contact; n normal out of the target; N = k <-g> >= 0, N; A(g) adhesion, N;
//          x place of the point in the target's frame, m; t tangential force, N; P = 1 - n n^T
//            t_trial = P t_old - k_t P (x - x_old),  |t| <= mu N,  force = (N - A) n + t
// Valid    the normal is taken as constant over a step of Newton's method: exact on planes
#pragma once

#include <Eigen/Core>
#include <cmath>

namespace pulvis::kernels {

struct ProbeLaw {
  double normal_stiffness, tangential_stiffness;  // N/m
  double friction;                                // -
  double pull_off, range;                         // N, m: of this point
  bool stick = false;  // predictor of an increment: as if mu were without bound
};

struct ProbePointForce {
  enum class State { apart, sticks, slides };
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  Eigen::Vector3d tangential = Eigen::Vector3d::Zero();
  Eigen::Matrix3d tangent = Eigen::Matrix3d::Zero();  // - d force / d x
  double normal_force = 0, limit = 0;                 // N; mu N
  State state = State::apart;
};

// Attraction and its derivative by the gap.
inline double adhesion(const ProbeLaw& law, double gap, double& slope) {
  slope = 0;
  if (law.pull_off == 0 || gap <= 0) return law.pull_off;
  const double fade = 1 / (1 + gap / law.range);
  slope = -2 * law.pull_off * fade * fade * fade / law.range;
  return law.pull_off * fade * fade;
}

inline ProbePointForce probe_force(const ProbeLaw& law, double gap, const Eigen::Vector3d& n,
                                   const Eigen::Vector3d& old_tangential,
                                   const Eigen::Vector3d& moved) {
  using Eigen::Matrix3d;
  using Eigen::Vector3d;
  ProbePointForce r;
  double slope = 0;
  const Matrix3d nn = n * n.transpose(), p = Matrix3d::Identity() - nn;
  r.force = -adhesion(law, gap, slope) * n;
  r.tangent = slope * nn;
  if (gap >= 0) return r;

  const double k = law.normal_stiffness, kt = law.tangential_stiffness;
  r.normal_force = -k * gap;
  r.limit = law.friction * r.normal_force;
  r.force += r.normal_force * n;
  r.tangent += k * nn;
  const Vector3d trial = p * (old_tangential - kt * moved);
  const double size = trial.norm();
  if ((size <= r.limit || law.stick) && law.friction > 0) {
    r.state = ProbePointForce::State::sticks;
    r.tangential = trial;
    r.tangent += kt * p;
  } else {
    r.state = ProbePointForce::State::slides;
    if (size > 0 && law.friction > 0) {
      const Vector3d m = trial / size;
      r.tangential = r.limit * m;
      r.tangent +=
          law.friction * k * m * n.transpose() + (r.limit * kt / size) * (p - m * m.transpose());
    }
  }
  r.force += r.tangential;
  return r;
}

}  // namespace pulvis::kernels
