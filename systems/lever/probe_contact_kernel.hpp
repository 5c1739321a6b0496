// One point of a probe against a rigid target: the conditions on its force, and their derivatives.
//
// Source   Alart & Curnier (1991): the unilateral condition and Coulomb's law as equations that are
//          differentiable except at non-smooth points, solved by Newton's method together with equilibrium.
//          Curnier & Alart's penalties are free parameters: near the stiffness behind the point (rho) the
//          method converges; the penalties of the law (k), a thousand times as stiff, make it alternate
//          between one sliding direction and the other forever.
//          Adhesion: a constant pull-off force in contact (Derjaguin, Muller & Toporov 1975) that decays
//          outside as 1/(1 + g/r)^2.
// Symbols  f force on the point, N; g gap, m, < 0 inside; n normal out of the target, H = dn/dx, 1/m;
//          A(g) adhesion, N; N = n.f + A pressing force >= 0, N; t = f - (n.f) n; P = 1 - n n^T
//          x - x_old displacement since the last equilibrium, m; t_old its tangential force, N
//            apart   f = -A n                                         where N^ <= 0
//          A point that touched before keeps the contact adhesion A(0) for as long as it may touch: it
//          separates when the force exceeds A(0), not when an increment's displacement has opened a gap.
//            touches g + N/k = 0,   N^ = N - rho (g + N/k)            where N^ > 0, and then
//            sticks  w = P (x - x_old) + (t - P t_old)/k_t = 0        where |t^| <= mu N^
//            slides  t = mu N^ t^/|t^|,   t^ = t - rho_t w
//          An adhesive elastic ball (JKR, systems/lever/jkr_kernel.hpp) touches, if it has had a force since then
//          or g <= 0, as long as it has a stable equilibrium with the spring rho:
//            touches n.f = F*,   F* + rho delta* = n.f - rho g,   F* = F_JKR(delta*),   N = F* + 3/2 pi w R
//            apart   f = 0
// Valid    any smooth surface; the derivatives are those of the equations, except at non-smooth points
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "systems/lever/jkr_kernel.hpp"

namespace pulvis::kernels {

struct ProbeLaw {
  double normal_stiffness, tangential_stiffness;  // N/m
  double friction;                                // -
  double pull_off, range;                         // N, m: for this point
  AdhesiveBall ball{};
};

// Position of the point, and its state at the last equilibrium.
struct ProbePlace {
  double gap;
  Eigen::Vector3d normal;
  Eigen::Matrix3d turn;  // 1/m, d normal / d position
  Eigen::Vector3d moved, old_tangential;
  bool touched = false;  // at the last equilibrium
};

struct ProbeEquation {
  enum class State { apart, sticks, slides };
  Eigen::Vector3d residual;            // N, zero where the law is satisfied
  Eigen::Matrix3d by_force, by_place;  // -, N/m
  double pressing, limit;              // N; mu N
  State state = State::apart;
};

// Attraction and its derivative with respect to the gap.
inline double adhesion(const ProbeLaw& law, double gap, double& slope) {
  slope = 0;
  if (law.pull_off == 0 || gap <= 0) return law.pull_off;
  const double fade = 1 / (1 + gap / law.range);
  slope = -2 * law.pull_off * fade * fade * fade / law.range;
  return law.pull_off * fade * fade;
}

// d (P v) / d position
inline Eigen::Matrix3d turned(const ProbePlace& at, const Eigen::Vector3d& v) {
  return -at.normal.dot(v) * at.turn - at.normal * (at.turn.transpose() * v).transpose();
}

// The friction limit, and its derivatives.
struct FrictionBound {
  double size = 0;  // N
  Eigen::RowVector3d by_force = Eigen::RowVector3d::Zero(), by_place = Eigen::RowVector3d::Zero();
};

// Adds the tangential law for a point that touches.
inline void add_friction(const ProbeLaw& law, const ProbePlace& at, const Eigen::Vector3d& f,
                         double rho_t, const FrictionBound& bound, ProbeEquation& r) {
  using Eigen::Matrix3d;
  using Eigen::Vector3d;
  const Matrix3d p = Matrix3d::Identity() - at.normal * at.normal.transpose();
  const double kt = law.tangential_stiffness;
  const Vector3d t = p * f;
  const Vector3d w = p * at.moved + (t - p * at.old_tangential) / kt;
  const Matrix3d w_by_place =
      p + turned(at, at.moved) + (turned(at, f) - turned(at, at.old_tangential)) / kt;
  const Vector3d trial = t - rho_t * w;
  const double size = trial.norm();
  if (size <= bound.size) {
    r.state = ProbeEquation::State::sticks;
    r.residual += rho_t * w;
    r.by_force += (rho_t / kt) * p;
    r.by_place += rho_t * w_by_place;
    return;
  }
  r.state = ProbeEquation::State::slides;
  const Vector3d m = trial / size;
  const Matrix3d across = (bound.size / size) * (Matrix3d::Identity() - m * m.transpose());
  r.residual += t - bound.size * m;
  r.by_force += p - m * bound.by_force - (1 - rho_t / kt) * across * p;
  r.by_place += turned(at, f) - across * (turned(at, f) - rho_t * w_by_place) - m * bound.by_place;
}

inline ProbeEquation adhesive_ball_equation(const ProbeLaw& law, const ProbePlace& at,
                                            const Eigen::Vector3d& f, double rho, double rho_t) {
  const Eigen::Vector3d& n = at.normal;
  const Eigen::Matrix3d &h = at.turn, nn = n * n.transpose();
  const double tau = n.dot(f) - rho * at.gap;
  ProbeEquation r;
  JkrAnswer balance;
  // Without a force it has lost contact, in this equilibrium search or before: being pulled back from afar by
  // what the spring alone would allow does not count as touching.
  const bool held = at.touched && f.squaredNorm() > 0;
  if (held || at.gap <= 0 || tau >= 0) balance = jkr_balance(JkrScale(law.ball), 1, rho, tau);
  if (!balance.holds) {
    r.residual = f;
    r.by_force.setIdentity();
    r.by_place.setZero();
    r.pressing = r.limit = 0;
    return r;
  }
  const double missing = n.dot(f) - balance.force;
  const Eigen::RowVector3d f_turned = (h.transpose() * f).transpose();
  r.residual = missing * n;
  r.by_force = (1 - balance.slope) * nn;
  r.by_place =
      n * ((1 - balance.slope) * f_turned + balance.slope * rho * n.transpose()) + missing * h;
  r.pressing = balance.force + law.pull_off;
  r.limit = law.friction * std::max(0.0, r.pressing);
  const double share = law.friction * balance.slope;
  add_friction(law, at, f, rho_t,
               {r.limit, share * n.transpose(), share * (f_turned - rho * n.transpose())}, r);
  return r;
}

inline ProbeEquation probe_equation(const ProbeLaw& law, const ProbePlace& at,
                                    const Eigen::Vector3d& f, double rho, double rho_t) {
  using Eigen::Matrix3d;
  using Eigen::Vector3d;
  if (law.ball.work > 0) return adhesive_ball_equation(law, at, f, rho, rho_t);
  const Vector3d& n = at.normal;
  const Matrix3d &h = at.turn, nn = n * n.transpose();
  double slope = 0;
  const double a = adhesion(law, at.gap, slope), k = law.normal_stiffness;
  const double pressing = n.dot(f) + (at.touched ? law.pull_off : a);
  const double missing = at.gap + pressing / k;
  const double augmented = pressing - rho * missing;
  const Vector3d pressing_by_place = (at.touched ? 0 : slope) * n + h.transpose() * f;
  const Vector3d missing_by_place = n + pressing_by_place / k;

  ProbeEquation r;
  r.pressing = pressing;
  r.limit = law.friction * std::max(0.0, pressing);
  if (augmented <= 0) {
    r.residual = f + a * n;
    r.by_force.setIdentity();
    r.by_place = slope * nn + a * h;
    return r;
  }
  r.residual = rho * missing * n;
  r.by_force = (rho / k) * nn;
  r.by_place = rho * (n * missing_by_place.transpose() + missing * h);
  add_friction(law, at, f, rho_t,
               {law.friction * augmented, law.friction * (1 - rho / k) * n.transpose(),
                law.friction * (pressing_by_place - rho * missing_by_place).transpose()},
               r);
  return r;
}

}  // namespace pulvis::kernels
