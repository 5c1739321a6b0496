// One eight-node hexahedron of a St. Venant-Kirchhoff material at large displacements: force and tangent.
//
// Source   Green-Lagrange strain enhanced by incompatible modes: Simo & Rifai (1990), Klinkel & Wagner
//          (1997): E = E_u + M alpha. As the energy is quadratic in E, alpha = -H^-1 q solves its equation
//          exactly for every displacement and needs no memory.
//          Thin layers: transverse shear sampled at the mid-edges, Dvorkin & Bathe (1984), so that a plate of
//          skewed or tapered elements does not lock; their modes leave transverse shear unchanged.
// Symbols  X, u [3, 8] corners and their displacements, m; xi, eta, zeta in [-1, 1]; J = dX/dxi;
//          E [6] 11 22 33 12 23 13, engineering shear; S [6] its stress (second Piola-Kirchhoff), Pa;
//          T [6, 6] from covariant to Cartesian strains; M = T(J_0) N(xi) det J_0 / det J
// Valid    strains small compared to 1; arbitrary rotations
#pragma once

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <optional>

#include "components/solid.hpp"

namespace pulvis::kernels {

inline constexpr std::array<std::array<int, 2>, 6> voigt_pair{
    {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {0, 2}}};
inline constexpr double corner_sign[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                                             {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};

// Where a thin layer samples its transverse shear: 0, 1 for row 13; 2, 3 for row 23.
inline constexpr double shear_points[4][3] = {{0, -1, 0}, {0, 1, 0}, {-1, 0, 0}, {1, 0, 0}};

// In double; in long double if the stiffness of a lever needs more digits (solid_extended.cpp).
template <class Real>
struct HexKernel {
  using Corners = Eigen::Matrix<Real, 3, 8>;
  using Voigt = Eigen::Matrix<Real, 6, 1>;
  using Voigt6 = Eigen::Matrix<Real, 6, 6>;
  using StrainRows = Eigen::Matrix<Real, 6, 24>;
  using NodalVector = Eigen::Matrix<Real, 24, 1>;
  using NodalMatrix = Eigen::Matrix<Real, 24, 24>;
  using ShapeGradient = Eigen::Matrix<Real, 8, 3>;  // dN_a / dxi_i
  using Modes = Eigen::Matrix<Real, 6, 9>;
  using ModeVector = Eigen::Matrix<Real, 9, 1>;
  using ModeMatrix = Eigen::Matrix<Real, 9, 9>;
  using ModeCoupling = Eigen::Matrix<Real, 9, 24>;
  using GeometricMatrix = Eigen::Matrix<Real, 8, 8>;
  using Vector3 = Eigen::Matrix<Real, 3, 1>;
  using Matrix3 = Eigen::Matrix<Real, 3, 3>;

  static Eigen::Matrix<Real, 8, 1> shape_functions(const Vector3& xi) {
    Eigen::Matrix<Real, 8, 1> n;
    for (int a = 0; a < 8; ++a) {
      const auto& s = corner_sign[a];
      n[a] = 0.125 * (1 + s[0] * xi[0]) * (1 + s[1] * xi[1]) * (1 + s[2] * xi[2]);
    }
    return n;
  }

  static ShapeGradient shape_gradient(const Vector3& xi) {
    ShapeGradient d;
    for (int a = 0; a < 8; ++a) {
      const auto& s = corner_sign[a];
      const Real x = 1 + s[0] * xi[0], y = 1 + s[1] * xi[1], z = 1 + s[2] * xi[2];
      d.row(a) << 0.125 * s[0] * y * z, 0.125 * x * s[1] * z, 0.125 * x * y * s[2];
    }
    return d;
  }

  static Vector3 vector_of(const double (&v)[3]) { return {v[0], v[1], v[2]}; }

  // Derivative of a nodal field by xi_i: a sum of differences along the four edges in that direction. What
  // both ends share, as top and bottom of a thin lever far from its clamp do, thus cancels before rounding:
  // a strain has the accuracy of the displacement differences, not of the displacements.
  static Vector3 gradient_of(const Corners& values, const ShapeGradient& d, int i) {
    static constexpr int edges[3][4][2] = {{{0, 1}, {3, 2}, {4, 5}, {7, 6}},
                                           {{0, 3}, {1, 2}, {4, 7}, {5, 6}},
                                           {{0, 4}, {1, 5}, {2, 6}, {3, 7}}};
    Vector3 sum = Vector3::Zero();
    for (const auto& [from, to] : edges[i]) sum += d(to, i) * (values.col(to) - values.col(from));
    return sum;
  }

  // Derivatives by all three coordinates; of X: the Jacobian.
  static Matrix3 gradients_of(const Corners& values, const ShapeGradient& d) {
    Matrix3 j;
    for (int i = 0; i < 3; ++i) j.col(i) = gradient_of(values, d, i);
    return j;
  }

  // Covariant base vectors at one point, and their changes.
  struct Bases {
    Matrix3 reference, change;

    Bases(const Corners& X, const Corners& u, const ShapeGradient& d)
        : reference(gradients_of(X, d)), change(gradients_of(u, d)) {}
  };

  // Covariant strains e and their derivative b by the corner displacements, at one point. Written
  // in u, not in current positions, so that tiny displacements keep all their digits.
  static void covariant_strain(const Bases& bases, const ShapeGradient& d, int row, Voigt& e,
                               StrainRows& b) {
    const auto [i, j] = entry(voigt_pair, row);
    const Vector3 Gi = bases.reference.col(i), Gj = bases.reference.col(j);
    const Vector3 Ui = bases.change.col(i), Uj = bases.change.col(j);
    const Real twice = Gi.dot(Uj) + Gj.dot(Ui) + Ui.dot(Uj);
    const Real share = i == j ? 0.5 : 1.0;
    e[row] = share * twice;
    for (int a = 0; a < 8; ++a)
      b.template block<1, 3>(row, 3 * a) =
          share * (d(a, i) * (Gj + Uj) + d(a, j) * (Gi + Ui)).transpose();
  }

  // From covariant to Cartesian strains, with J^-1, whose rows are the contravariant base vectors.
  static Voigt6 strain_transformation(const Matrix3& inverse) {
    Voigt6 t;
    for (int r = 0; r < 6; ++r) {
      const auto [a, b] = entry(voigt_pair, r);
      const Real twice = a == b ? 1 : 2;
      for (int c = 0; c < 6; ++c) {
        const auto [i, j] = entry(voigt_pair, c);
        t(r, c) =
            i == j ? twice * inverse(i, a) * inverse(i, b)
                   : 0.5 * twice * (inverse(i, a) * inverse(j, b) + inverse(j, a) * inverse(i, b));
      }
    }
    return t;
  }

  static Modes natural_modes(const Vector3& xi, HexFormulation formulation) {
    Modes m = Modes::Zero();
    if (formulation == HexFormulation::standard) return m;
    m(0, 0) = xi[0];
    m(1, 1) = xi[1];
    m(2, 2) = xi[2];
    m(3, 3) = xi[0];
    m(3, 4) = xi[1];
    if (formulation == HexFormulation::plate) {
      m(2, 5) = xi[0] * xi[2];
      m(2, 6) = xi[1] * xi[2];
      m(2, 7) = xi[0] * xi[1] * xi[2];
      m(3, 8) = xi[0] * xi[1];
    } else {
      m(4, 5) = xi[1];
      m(4, 6) = xi[2];
      m(5, 7) = xi[0];
      m(5, 8) = xi[2];
    }
    return m;
  }

  static Voigt6 elasticity(Real lambda, Real mu) {
    Voigt6 c = Voigt6::Zero();
    c.template topLeftCorner<3, 3>().setConstant(lambda);
    c.diagonal() << lambda + 2 * mu, lambda + 2 * mu, lambda + 2 * mu, mu, mu, mu;
    return c;
  }

  struct ThinShear {
    Voigt e[4];
    StrainRows b[4];
    ShapeGradient gradient[4];

    ThinShear(const Corners& X, const Corners& u) {
      for (int k = 0; k < 4; ++k) {
        gradient[k] = shape_gradient(vector_of(shear_points[k]));
        covariant_strain(Bases(X, u, gradient[k]), gradient[k], row(k), e[k], b[k]);
      }
    }
    // Only plates have it.
    static std::optional<ThinShear> of(const Corners& X, const Corners& u,
                                       HexFormulation formulation) {
      return formulation == HexFormulation::plate ? std::optional<ThinShear>(std::in_place, X, u)
                                                  : std::nullopt;
    }
    static constexpr int row(int k) { return k < 2 ? 5 : 4; }
    static Real weight(int k, const Vector3& xi) {
      const Real s = k < 2 ? xi[1] : xi[0];
      return 0.5 * (1 + (k % 2 == 0 ? -s : s));
    }
  };

  // The data of one Gauss point that both passes need.
  struct Point {
    Real volume = 0;  // m^3, det J times the Gauss weight
    Voigt strain;     // from the displacements alone
    StrainRows b;     // derivative of the covariant strains
    Modes modes;
    Voigt6 transformation;
    ShapeGradient gradient;
    Vector3 xi;

    StrainRows strain_derivative() const { return transformation.lazyProduct(b); }
    // Of a Cartesian stress; its components are contravariant, times the volume.
    Voigt pushed(const Voigt& stress) const {
      return volume * (transformation.transpose() * stress);
    }
  };

  static Point hex_point(const Corners& X, const Corners& u, const Vector3& xi,
                         const Voigt6& central, Real central_determinant,
                         HexFormulation formulation, const std::optional<ThinShear>& shear) {
    Point p;
    p.xi = xi;
    p.gradient = shape_gradient(xi);
    const Bases bases(X, u, p.gradient);
    p.volume = bases.reference.determinant();
    p.transformation = strain_transformation(bases.reference.inverse());
    Voigt e = Voigt::Zero();
    p.b.setZero();
    for (int row = 0; row < (shear ? 4 : 6); ++row)
      covariant_strain(bases, p.gradient, row, e, p.b);
    for (int k = 0; shear && k < 4; ++k) {
      const int row = ThinShear::row(k);
      const Real w = ThinShear::weight(k, xi);
      e[row] += w * shear->e[k][row];
      p.b.row(row) += w * shear->b[k].row(row);
    }
    p.strain = p.transformation * e;
    p.modes.noalias() =
        (central_determinant / p.volume) * central.lazyProduct(natural_modes(xi, formulation));
    return p;
  }

  // Adds s^ij dN_a/dxi_i dN_b/dxi_j, the geometric stiffness of a pushed stress.
  static void add_geometric(const Point& p, const Voigt& s, const std::optional<ThinShear>& shear,
                            GeometricMatrix& g) {
    const auto add = [&](const ShapeGradient& d, int row, Real stress) {
      const auto [i, j] = entry(voigt_pair, row);
      const Real share = i == j ? 0.5 : 1.0;
      g += (share * stress) * (d.col(i) * d.col(j).transpose() + d.col(j) * d.col(i).transpose());
    };
    for (int row = 0; row < (shear ? 4 : 6); ++row) add(p.gradient, row, s[row]);
    for (int k = 0; shear && k < 4; ++k)
      add(shear->gradient[k], ThinShear::row(k), ThinShear::weight(k, p.xi) * s[ThinShear::row(k)]);
  }

  static std::array<Point, 8> points_of(const Corners& X, const Corners& u,
                                        HexFormulation formulation,
                                        const std::optional<ThinShear>& shear) {
    const Matrix3 middle = gradients_of(X, shape_gradient(Vector3::Zero()));
    const Voigt6 central = strain_transformation(middle.inverse());
    std::array<Point, 8> points;
    for (std::size_t g = 0; g < 8; ++g)
      points[g] = hex_point(X, u, vector_of(corner_sign[g]) / std::sqrt(Real(3)), central,
                            middle.determinant(), formulation, shear);
    return points;
  }

  // Initial value of the mode equations; without modes they stay solvable.
  static ModeMatrix no_modes_yet(HexFormulation formulation) {
    return formulation == HexFormulation::standard ? ModeMatrix(ModeMatrix::Identity())
                                                   : ModeMatrix(ModeMatrix::Zero());
  }

  static Real min_volume(const std::array<Point, 8>& points) {
    Real minimum = points[0].volume;
    for (const Point& p : points) minimum = std::min(minimum, p.volume);
    return minimum;
  }

  // Adds the derivative c of a point's stress, with that of its strain, to the tangent, without the modes.
  static void add_tangent(const Point& p, const Voigt6& c, const StrainRows& derivative,
                          NodalMatrix& tangent) {
    const StrainRows cb = p.volume * c.lazyProduct(derivative);
    tangent.noalias() += derivative.transpose().lazyProduct(cb);
  }

  // Condenses out the modes, with h the tangent of their equations; adds the geometric part to the diagonals.
  static void finish_tangent(const ModeCoupling& l, const Eigen::LLT<ModeMatrix>& h,
                             const GeometricMatrix& geometric, NodalMatrix& tangent) {
    tangent.noalias() -= l.transpose().lazyProduct(h.solve(l).eval());
    for (int a = 0; a < 8; ++a)
      for (int b = 0; b < 8; ++b)
        tangent.template block<3, 3>(3 * a, 3 * b).diagonal().array() += geometric(a, b);
  }

  struct Response {
    NodalVector force = NodalVector::Zero();    // N, the forces that hold the element in place
    NodalMatrix tangent = NodalMatrix::Zero();  // N/m
    Real energy = 0;                            // J
    Real min_determinant = 0;                   // of J, m^3; <= 0: the element is inverted
  };

  static Response response(const Corners& X, const Corners& u, Real lambda, Real mu,
                           HexFormulation formulation, bool with_tangent = true) {
    const auto shear = ThinShear::of(X, u, formulation);
    const Voigt6 c = elasticity(lambda, mu);
    Response r;
    const std::array<Point, 8> points = points_of(X, u, formulation, shear);
    r.min_determinant = min_volume(points);

    ModeMatrix h = no_modes_yet(formulation);
    ModeCoupling l = ModeCoupling::Zero();
    ModeVector q = ModeVector::Zero();
    for (const Point& p : points) {
      const Eigen::Matrix<Real, 9, 6> mc = p.volume * p.modes.transpose().lazyProduct(c);
      h.noalias() += mc.lazyProduct(p.modes);
      if (with_tangent) {
        const StrainRows derivative = p.strain_derivative();
        l.noalias() += mc.lazyProduct(derivative);
        add_tangent(p, c, derivative, r.tangent);
      }
      q.noalias() += mc.lazyProduct(p.strain);
    }
    const Eigen::LLT<ModeMatrix> h_factor(h);
    const ModeVector alpha = -h_factor.solve(q);

    GeometricMatrix geometric = GeometricMatrix::Zero();
    for (const Point& p : points) {
      const Voigt strain = p.strain + p.modes * alpha;
      const Voigt stress = c * strain;
      r.energy += 0.5 * p.volume * strain.dot(stress);
      const Voigt pushed = p.pushed(stress);
      r.force.noalias() += p.b.transpose().lazyProduct(pushed);
      if (with_tangent) add_geometric(p, pushed, shear, geometric);
    }
    if (with_tangent) finish_tangent(l, h_factor, geometric, r.tangent);
    return r;
  }
};

using Hex = HexKernel<double>;
using Corners = Hex::Corners;
using Voigt = Hex::Voigt;
using Voigt6 = Hex::Voigt6;
using ModeVector = Hex::ModeVector;
using ModeMatrix = Hex::ModeMatrix;
using ModeCoupling = Hex::ModeCoupling;
using GeometricMatrix = Hex::GeometricMatrix;
using ThinShear = Hex::ThinShear;
using HexPoint = Hex::Point;
using HexResponse = Hex::Response;

inline HexResponse hex_response(const Corners& X, const Corners& u, double lambda, double mu,
                                HexFormulation formulation, bool with_tangent = true) {
  return Hex::response(X, u, lambda, mu, formulation, with_tangent);
}

}  // namespace pulvis::kernels
