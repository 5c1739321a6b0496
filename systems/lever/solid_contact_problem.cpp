#include "systems/lever/solid_contact_problem.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace pulvis {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr int max_iterations = 60;
constexpr int max_cuts = 12;         // step halvings of the line search
constexpr int max_steps = 400;       // of the flow during a jump
constexpr double tolerance = 1e-11;  // -, relative to the largest force

struct Linearised {
  MatrixXd matrix;  // for the forces, then the servo's row and column
  VectorXd missing;
  bool touches = false;
};

class ContactNewton {
 public:
  explicit ContactNewton(const ContactProblem& problem)
      : problem_(problem), size_(3 * static_cast<Index>(problem.points.size())) {
    start_.resize(size_);
    for (Index p = 0; p < size_ / 3; ++p) start_.segment<3>(3 * p) = point(p).force;
    force_ = start_;
    if (problem_.set_point) follow();
  }

  // Full steps almost always converge in a few iterations; where the normal rotates quickly (valleys) they
  // throw the probe from side to side, and a line search on the residual does not.
  ContactAnswer solve(bool line_search) {
    int i = 0;
    for (; i < max_iterations; ++i) {
      Linearised now = linearise();
      if (problem_.set_point && !now.touches) {
        press_nearest();
        now = linearise();
      }
      const double largest =
          std::max({force_.lpNorm<Eigen::Infinity>(), std::abs(problem_.set_point.value_or(0)),
                    std::ranges::max(problem_.points, {}, [](const ContactPoint& point) {
                      return point.law.pull_off;
                    }).law.pull_off});
      if (now.missing.norm() <= tolerance * largest) return {true, force_, height_, i, 0};
      const VectorXd step = now.matrix.partialPivLu().solve(now.missing);
      if (!step.allFinite()) break;
      move(step, 1);
      double share = 1;
      const double before = now.missing.norm();
      for (int cut = 0; line_search && cut < max_cuts; ++cut) {
        if (linearise().missing.norm() < (1 - 1e-4 * share) * before) break;
        share /= 2;
        move(step, -share);
      }
    }
    return {false, force_, height_, i, 0};
  }

 private:
  const ContactPoint& point(Index p) const { return entry(problem_.points, p); }

  void move(const VectorXd& step, double share) {
    force_ += share * step.head(size_);
    if (problem_.set_point) height_ += share * step[size_];
  }

  kernels::ProbePlace place(Index p) const {
    const Vector3d moved = problem_.compliance.middleRows<3>(3 * p) * (force_ - start_);
    return place_on(*problem_.shape, point(p), problem_.end_radius,
                    point(p).place + moved - height_ * Vector3d::UnitZ());
  }

  // The target follows the point that pressed hardest: an increment's displacement along a slope must not tear the
  // probe off before the contact law has been evaluated.
  void follow() {
    Index hardest = -1;
    double maximum = 0;
    for (Index p = 0; p < size_ / 3; ++p) {
      const double pressing = place(p).normal.dot(start_.segment<3>(3 * p));
      if (pressing > maximum) maximum = pressing, hardest = p;
    }
    if (hardest < 0) return;
    const auto at = place(hardest);
    height_ = (at.gap + maximum / point(hardest).law.normal_stiffness) / at.normal.z();
  }

  // Nothing touches, but the servo needs its force: the nearest point takes it.
  void press_nearest() {
    Index nearest = 0;
    double gap = place(0).gap;
    for (Index p = 1; p < size_ / 3; ++p)
      if (place(p).gap < gap) gap = place(p).gap, nearest = p;
    const double held = force_(Eigen::seqN(2, size_ / 3, 3)).sum();
    const auto at = place(nearest);
    force_.segment<3>(3 * nearest) += (*problem_.set_point - held) / at.normal.z() * at.normal;
    const auto then = place(nearest);
    height_ += (then.gap + then.normal.dot(force_.segment<3>(3 * nearest)) /
                               point(nearest).law.normal_stiffness) /
               then.normal.z();
  }

  Linearised linearise() const {
    const bool servo = problem_.set_point.has_value();
    Linearised now;
    now.matrix.setZero(size_ + servo, size_ + servo);
    now.missing.setZero(size_ + servo);
    for (Index p = 0; p < size_ / 3; ++p) {
      const auto at = place(p);
      const Matrix3d s = problem_.compliance.block<3, 3>(3 * p, 3 * p);
      const double give = at.normal.dot(s * at.normal);
      const auto r = kernels::probe_equation(point(p).law, at, force_.segment<3>(3 * p), 1 / give,
                                             1 / (s.trace() - give));
      now.touches = now.touches || r.state != kernels::ProbeEquation::State::apart;
      now.missing.segment<3>(3 * p) = -r.residual;
      now.matrix.block(3 * p, 0, 3, size_) = r.by_place * problem_.compliance.middleRows<3>(3 * p);
      now.matrix.block<3, 3>(3 * p, 3 * p) += r.by_force;
      if (servo) {
        now.matrix.block<3, 1>(3 * p, size_) = -r.by_place.col(2);
        now.matrix(size_, 3 * p + 2) = 1;
      }
    }
    if (servo)
      now.missing[size_] = *problem_.set_point - force_(Eigen::seqN(2, size_ / 3, 3)).sum();
    return now;
  }

  const ContactProblem& problem_;
  Index size_;
  VectorXd start_, force_;
  double height_ = 0;
};

ContactAnswer settle(const ContactProblem& problem) {
  const ContactAnswer answer = ContactNewton(problem).solve(false);
  return answer.converged ? answer : ContactNewton(problem).solve(true);
}

// No equilibrium is nearby: the adhesion (DMT) gradient exceeds the lever's stiffness. The points flow to the
// next one against dashpots c that are removed step by step, x + c S (x - x_k) = x_0 + S (f - f_0); the energy
// dissipated by the dashpots is what a real snap radiates.
ContactAnswer jump(const ContactProblem& problem) {
  // Eigen blocks large products, and with them their sums, by the cache sizes of the processor.
  Eigen::setCpuCacheSizes(32 << 10, 256 << 10, 2 << 20);
  const MatrixXd& s = problem.compliance;
  const auto size = s.rows();
  const MatrixXd one = MatrixXd::Identity(size, size);
  VectorXd x(size), force(size);
  double steepest = 0;
  for (Index p = 0; p < size / 3; ++p) {
    const ContactPoint& point = entry(problem.points, p);
    x.segment<3>(3 * p) = point.place;
    force.segment<3>(3 * p) = point.force;
    steepest = std::max(steepest, 2 * point.law.pull_off / point.law.range);
  }
  const VectorXd unpressed = x - s * force;
  const auto in_touch = [&](Index p, const VectorXd& places) {
    const ContactPoint& point = entry(problem.points, p);
    const Vector3d at = places.segment<3>(3 * p);
    return point.touched && place_on(*problem.shape, point, problem.end_radius, at).gap <= 0;
  };
  const double softest = 1 / s.diagonal().maxCoeff();
  double c = 10 * std::max(steepest, softest), eaten = 0;
  for (int i = 0; i < max_steps && c > 1e-5 * softest; ++i) {
    const Eigen::PartialPivLU<MatrixXd> damped(one + c * s);
    ContactProblem step = problem;
    step.compliance = damped.solve(s);
    const VectorXd place = damped.solve(unpressed + c * (s * x)) + step.compliance * force;
    for (Index p = 0; p < size / 3; ++p) {
      entry(step.points, p).place = place.segment<3>(3 * p);
      entry(step.points, p).force = force.segment<3>(3 * p);
      entry(step.points, p).touched = in_touch(p, x);
    }
    const ContactAnswer answer = settle(step);
    if (!answer.converged) {
      c *= 8;
      continue;
    }
    const VectorXd then = place + step.compliance * (answer.force - force);
    eaten += c * (then - x).squaredNorm();
    x = then;
    force = answer.force;
    c /= 2;
  }
  ContactProblem end = problem;
  const VectorXd place = unpressed + s * force;
  for (Index p = 0; p < size / 3; ++p) {
    entry(end.points, p).place = place.segment<3>(3 * p);
    entry(end.points, p).force = force.segment<3>(3 * p);
    entry(end.points, p).touched = in_touch(p, x);
  }
  ContactAnswer answer = settle(end);
  answer.released = eaten;
  return answer;
}

}  // namespace

ContactAnswer solve_contact(const ContactProblem& problem) {
  ContactAnswer answer = settle(problem);
  // The law of an adhesive ball jumps by itself.
  const bool by_law = problem.points.front().law.ball.work > 0;
  if (!answer.converged && problem.may_jump && !problem.set_point && !by_law)
    answer = jump(problem);
  return answer;
}

kernels::ProbePlace place_on(const TargetShape& shape, const ContactPoint& point, double end_radius,
                             const Vector3d& place) {
  const auto nearest = shape.nearest({place.x(), place.y(), place.z() + end_radius});
  return {nearest.distance - end_radius,
          Vector3d(nearest.normal.data()),
          Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(nearest.turn.data()),
          place - point.before,
          point.old_tangential,
          point.touched};
}

Vector3d probe_place(int node, const Configuration& configuration, const Target& target) {
  const Row<SolidNode> row(node);
  Vector3d x, u;
  for (int k = 0; k < 3; ++k) {
    x[k] = configuration.reference(row, k);
    u[k] = configuration.displacement(row, k);
  }
  return place_from(target, x, u);
}

Vector3d place_from(const Target& target, const Vector3d& reference, const Vector3d& displacement) {
  return (reference - Vector3d(target.origin.data())) +
         (displacement - Vector3d(target.travel.data()));
}

ContactPoint contact_point(Row<ProbePoint> row, const Vector3d& place, const Target& target,
                           const Probe& probe) {
  ContactPoint point;
  point.law = {probe.stiffness(row, 0),
               probe.stiffness(row, 1),
               target.friction,
               target.pull_off * probe.share(row),
               target.range,
               target.ball};
  point.place = place;
  for (int k = 0; k < 3; ++k) {
    point.force[k] = probe.force(row, k);
    point.old_tangential[k] = probe.memory(row, k);
    point.before[k] = probe.memory(row, 3 + k);
  }
  point.touched = probe.memory(row, 6) != 0;
  return point;
}

}  // namespace pulvis
