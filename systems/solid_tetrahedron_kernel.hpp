// One ten-node tetrahedron of a St. Venant-Kirchhoff material at large displacements: force and tangent.
//
// Source   Total Lagrangian with quadratic shape functions and straight edges, so that the Jacobian is
//          constant (Bathe 1996, secs. 5.3, 6.3); four Gauss points, exact for the linear element's energy:
//          4 x 6 strains are as many as the 30 displacements less six rigid motions
// Symbols  X, u [3, 10] nodes and their displacements, m; E Green-Lagrange strain, S its stress (second
//          Piola-Kirchhoff), Pa; H = du/dX; L barycentric coordinates
// Valid    strains small against 1; rotations of any size
#pragma once

#include <Eigen/Dense>
#include <array>
#include <cmath>

#include "systems/solid_kernel.hpp"

namespace pulvis::kernels {

using TetrahedronNodes = Eigen::Matrix<double, 3, 10>;
using TetrahedronGradient = Eigen::Matrix<double, 10, 3>;  // dN_a / dX_i, 1/m

struct TetrahedronResponse {
  Eigen::Matrix<double, 30, 1> force = Eigen::Matrix<double, 30, 1>::Zero();      // N
  Eigen::Matrix<double, 30, 30> tangent = Eigen::Matrix<double, 30, 30>::Zero();  // N/m
  double energy = 0;                                                              // J
};

// Corners between which the nodes 4 to 9 lie.
inline constexpr int tetrahedron_edge[6][2] = {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {2, 3}, {1, 3}};

// `barycentric`: dL/dX of the four corners.
inline TetrahedronGradient tetrahedron_gradient(const Eigen::Vector4d& l,
                                                const Eigen::Matrix<double, 4, 3>& barycentric) {
  TetrahedronGradient d;
  for (int a = 0; a < 4; ++a) d.row(a) = (4 * l[a] - 1) * barycentric.row(a);
  for (int e = 0; e < 6; ++e) {
    const auto& [a, b] = tetrahedron_edge[e];
    d.row(4 + e) = 4 * (l[b] * barycentric.row(a) + l[a] * barycentric.row(b));
  }
  return d;
}

inline TetrahedronResponse tetrahedron_response(const TetrahedronNodes& X,
                                                const TetrahedronNodes& u, double lambda, double mu,
                                                bool with_tangent = true) {
  using Eigen::Matrix3d;
  Matrix3d jacobian;
  for (int i = 0; i < 3; ++i) jacobian.col(i) = X.col(i + 1) - X.col(0);
  Eigen::Matrix<double, 4, 3> barycentric;
  barycentric.bottomRows<3>() = jacobian.inverse();
  barycentric.row(0) = -barycentric.bottomRows<3>().colwise().sum();
  const double volume = jacobian.determinant() / 24;  // of each Gauss point
  // What all nodes share drops out before it is rounded.
  const TetrahedronNodes own = u.colwise() - u.col(0);
  const Voigt6 c = elasticity(lambda, mu);

  TetrahedronResponse r;
  for (int g = 0; g < 4; ++g) {
    static const double near = (5 + 3 * std::sqrt(5.0)) / 20, far = (5 - std::sqrt(5.0)) / 20;
    Eigen::Vector4d l = Eigen::Vector4d::Constant(far);
    l[g] = near;
    const TetrahedronGradient d = tetrahedron_gradient(l, barycentric);
    const Matrix3d h = own.lazyProduct(d);
    const Matrix3d f = Matrix3d::Identity() + h;
    const Matrix3d e = 0.5 * (h + h.transpose() + h.transpose() * h);
    const Matrix3d s = lambda * e.trace() * Matrix3d::Identity() + 2 * mu * e;
    r.energy += 0.5 * volume * e.cwiseProduct(s).sum();
    const Matrix3d first = volume * f * s;  // of Piola and Kirchhoff
    const TetrahedronNodes nodal = first.lazyProduct(d.transpose());
    r.force += nodal.reshaped();
    if (!with_tangent) continue;
    Eigen::Matrix<double, 6, 30> b;
    for (int a = 0; a < 10; ++a)
      for (int row = 0; row < 6; ++row) {
        const auto [i, j] = voigt_pair[static_cast<std::size_t>(row)];
        const double share = i == j ? 0.5 : 1.0;
        b.block<1, 3>(row, 3 * a) = share * (d(a, i) * f.col(j) + d(a, j) * f.col(i)).transpose();
      }
    const Eigen::Matrix<double, 6, 30> cb = volume * c.lazyProduct(b);
    r.tangent.noalias() += b.transpose().lazyProduct(cb);
    const TetrahedronGradient ds = volume * d.lazyProduct(s);
    const Eigen::Matrix<double, 10, 10> geometric = ds.lazyProduct(d.transpose());
    for (int a = 0; a < 10; ++a)
      for (int k = 0; k < 10; ++k)
        r.tangent.block<3, 3>(3 * a, 3 * k).diagonal().array() += geometric(a, k);
  }
  return r;
}

}  // namespace pulvis::kernels
