// One ten-node tetrahedron of a St. Venant-Kirchhoff material at large displacements: force and tangent.
//
// Source   Total Lagrangian with quadratic shape functions and straight edges, so that the Jacobian is
//          constant (Bathe 1996, secs. 5.3, 6.3); four Gauss points, exact for the linear element's energy:
//          4 x 6 strains match the 30 displacements less six rigid motions
// Symbols  X, u [3, 10] nodes and their displacements, m; E Green-Lagrange strain, S its stress (second
//          Piola-Kirchhoff), Pa; H = du/dX; L barycentric coordinates
// Valid    strains small compared to 1; arbitrary rotations
#pragma once

#include <Eigen/Dense>
#include <array>
#include <cmath>

#include "systems/lever/solid_kernel.hpp"

namespace pulvis::kernels {

// Corners of the edges on which nodes 4 to 9 lie.
inline constexpr int tetrahedron_edge[6][2] = {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {2, 3}, {1, 3}};

// Like HexKernel, in double or long double.
template <class Real>
struct TetrahedronKernel {
  using Nodes = Eigen::Matrix<Real, 3, 10>;
  using Gradient = Eigen::Matrix<Real, 10, 3>;  // dN_a / dX_i, 1/m

  struct Response {
    Eigen::Matrix<Real, 30, 1> force = Eigen::Matrix<Real, 30, 1>::Zero();      // N
    Eigen::Matrix<Real, 30, 30> tangent = Eigen::Matrix<Real, 30, 30>::Zero();  // N/m
    Real energy = 0;                                                            // J
  };
  using Matrix3 = Eigen::Matrix<Real, 3, 3>;
  using Vector4 = Eigen::Matrix<Real, 4, 1>;
  using Voigt6 = typename HexKernel<Real>::Voigt6;

  // `barycentric`: dL/dX of the four corners.
  static Gradient gradient(const Vector4& l, const Eigen::Matrix<Real, 4, 3>& barycentric) {
    Gradient d;
    for (int a = 0; a < 4; ++a) d.row(a) = (4 * l[a] - 1) * barycentric.row(a);
    for (int e = 0; e < 6; ++e) {
      const auto& [a, b] = tetrahedron_edge[e];
      d.row(4 + e) = 4 * (l[b] * barycentric.row(a) + l[a] * barycentric.row(b));
    }
    return d;
  }

  static Response response(const Nodes& X, const Nodes& u, Real lambda, Real mu,
                           bool with_tangent = true) {
    Matrix3 jacobian;
    for (int i = 0; i < 3; ++i) jacobian.col(i) = X.col(i + 1) - X.col(0);
    Eigen::Matrix<Real, 4, 3> barycentric;
    barycentric.template bottomRows<3>() = jacobian.inverse();
    barycentric.row(0) = -barycentric.template bottomRows<3>().colwise().sum();
    const Real volume = jacobian.determinant() / 24;  // of each Gauss point
    // The common translation cancels before it is rounded.
    const Nodes own = u.colwise() - u.col(0);
    const Voigt6 c = HexKernel<Real>::elasticity(lambda, mu);

    Response r;
    for (int g = 0; g < 4; ++g) {
      static const Real near = (5 + 3 * std::sqrt(Real(5))) / 20,
                        far = (5 - std::sqrt(Real(5))) / 20;
      Vector4 l = Vector4::Constant(far);
      l[g] = near;
      const Gradient d = gradient(l, barycentric);
      const Matrix3 h = own.lazyProduct(d);
      const Matrix3 f = Matrix3::Identity() + h;
      const Matrix3 e = Real(0.5) * (h + h.transpose() + h.transpose() * h);
      const Matrix3 s = lambda * e.trace() * Matrix3::Identity() + 2 * mu * e;
      r.energy += 0.5 * volume * e.cwiseProduct(s).sum();
      const Matrix3 first = volume * f * s;  // first Piola-Kirchhoff stress times volume
      const Nodes nodal = first.lazyProduct(d.transpose());
      r.force += nodal.reshaped();
      if (!with_tangent) continue;
      Eigen::Matrix<Real, 6, 30> b;
      for (int a = 0; a < 10; ++a)
        for (int row = 0; row < 6; ++row) {
          const auto [i, j] = entry(voigt_pair, row);
          const Real share = i == j ? 0.5 : 1.0;
          b.template block<1, 3>(row, 3 * a) =
              share * (d(a, i) * f.col(j) + d(a, j) * f.col(i)).transpose();
        }
      const Eigen::Matrix<Real, 6, 30> cb = volume * c.lazyProduct(b);
      r.tangent.noalias() += b.transpose().lazyProduct(cb);
      const Gradient ds = volume * d.lazyProduct(s);
      const Eigen::Matrix<Real, 10, 10> geometric = ds.lazyProduct(d.transpose());
      for (int a = 0; a < 10; ++a)
        for (int k = 0; k < 10; ++k)
          r.tangent.template block<3, 3>(3 * a, 3 * k).diagonal().array() += geometric(a, k);
    }
    return r;
  }
};

using Tetrahedron = TetrahedronKernel<double>;
using TetrahedronNodes = Tetrahedron::Nodes;
using TetrahedronResponse = Tetrahedron::Response;

inline TetrahedronResponse tetrahedron_response(const TetrahedronNodes& X,
                                                const TetrahedronNodes& u, double lambda, double mu,
                                                bool with_tangent = true) {
  return Tetrahedron::response(X, u, lambda, mu, with_tangent);
}

}  // namespace pulvis::kernels
