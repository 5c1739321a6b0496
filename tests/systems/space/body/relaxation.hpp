// Equilibrium of blocks: small displacements by their stiffness, large ones by damped motion.
#pragma once

#include "tests/systems/space/body/blocks.hpp"

namespace pulvis::space {

using Displacements = Eigen::VectorXd;

// K u = f with K by central differences of the internal force; `held(x, k)` says which displacements are none.
template <class F, class Held, class Force>
Displacements small_displacements(Body<F>& body, const Held& held, const Force& force_at) {
  const int unknowns = 3 * body.nodes();
  const double h = 1e-6;
  Eigen::MatrixXd k(unknowns, unknowns);
  Eigen::VectorXd load(unknowns);
  std::vector<int> fixed;
  for (int j = 0; j < unknowns; ++j) {
    const Vector at = body.position(j / 3), step = h * Vector::Unit(j % 3);
    const auto column = [&](const Vector& x) {
      body.put(j / 3, x);
      body.find_forces();
      Eigen::VectorXd f(unknowns);
      for (int n = 0; n < body.nodes(); ++n) f.segment<3>(3 * n) = body.force(n);
      return f;
    };
    const Eigen::VectorXd plus = column(at + step);
    k.col(j) = (column(at - step) - plus) / (2 * h);
    body.put(j / 3, at);
    load[j] = Vector(force_at(at))[j % 3];
    if (held(at, j % 3)) fixed.push_back(j);
  }
  for (const int j : fixed) {
    k.row(j).setZero();
    k.col(j).setZero();
    k(j, j) = 1;
    load[j] = 0;
  }
  return k.partialPivLu().solve(load);
}

// Slow, damped motion: `steps` of nine tenths of the stable step, velocities losing a share in each.
// `hold(n, share, x, v)` puts what is prescribed of a node when that share of the steps is done.
template <class F, class Hold>
void move_slowly(Body<F>& body, int steps, const Hold& hold) {
  std::vector<Vector> v(std::size_t(body.nodes()), Vector::Zero());
  const double rho = body.template number<Density>(0);
  double dt = 0;
  for (int step = 0; step < steps; ++step) {
    body.find_forces();
    if (step % 100 == 0) {
      body.template run<stable_time_step<F>>();
      dt = 0.9 * body.template number<StableTimeStep>(0);
    }
    for (int n = 0; n < body.nodes(); ++n) {
      Vector& speed = v[std::size_t(n)];
      const double mass = rho * body.shape().nodal_volume[std::size_t(n)];
      speed = Vector(0.99 * speed + dt / mass * body.force(n));
      Vector x = body.position(n) + dt * speed;
      hold(n, double(step + 1) / steps, x, speed);
      body.put(n, x);
    }
  }
  body.find_forces();
}

}  // namespace pulvis::space
