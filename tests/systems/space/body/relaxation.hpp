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

}  // namespace pulvis::space
