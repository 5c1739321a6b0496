// Constants of hexahedra: mean gradients, fibres, masses.
//
// Source   mean gradient: Flanagan & Belytschko (1981). All integrands are at most quadratic in xi, eta and zeta,
//          or cubic for the masses: the 2 x 2 x 2 Gauss points integrate them exactly
#include "scenes/meshes/hexahedra/element_constants.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <stdexcept>

#include "scenes/meshes/inerter_chains.hpp"

namespace pulvis::space {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Corners = Eigen::Matrix<double, 3, 8>;  // columns: nodes

const double gauss_point = 1 / std::sqrt(3.0);

struct AtPoint {
  Eigen::Matrix<double, 8, 1> shape;  // N_I
  Eigen::Matrix<double, 8, 3> by_xi;  // dN_I/d(xi, eta, zeta)
};

AtPoint shape_functions(const Vector3d& xi) {
  AtPoint at;
  for (int i = 0; i < 8; ++i) {
    Vector3d sign, factor;
    for (int k = 0; k < 3; ++k) {
      sign[k] = Shape::mode_sign(k, i);
      factor[k] = 0.5 * (1 + sign[k] * xi[k]);
    }
    at.shape[i] = factor.prod();
    for (int k = 0; k < 3; ++k)
      at.by_xi(i, k) = 0.5 * sign[k] * factor[(k + 1) % 3] * factor[(k + 2) % 3];
  }
  return at;
}

Vector3d gauss_coordinates(int g) {
  return gauss_point * Vector3d(g & 1 ? 1 : -1, g & 2 ? 1 : -1, g & 4 ? 1 : -1);
}

Tensor to_tensor(const Matrix3d& m) {
  Tensor t;
  for (int i = 0; i < 9; ++i) entry(t, i) = m(i / 3, i % 3);
  return t;
}
Point to_point(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }

Corners corners_of(const Shape& shape, int element) {
  Corners x;
  for (int i = 0; i < 8; ++i) {
    const Point& p = entry(shape.nodes, entry(entry(shape.hexahedra, element), i));
    x.col(i) = Vector3d(p[0], p[1], p[2]);
  }
  return x;
}

struct Integrals {
  std::array<Shape::GaussPoint, 8> points;
  double volume = 0;
  Eigen::Matrix<double, 8, 3> gradient = Eigen::Matrix<double, 8, 3>::Zero();  // 1/m, mean
  Eigen::Matrix<double, 8, 1> shares = Eigen::Matrix<double, 8, 1>::Zero();    // m^3, of the nodes
};

Integrals integrals_of(const Corners& x, int element) {
  Integrals sum;
  for (int g = 0; g < 8; ++g) {
    const AtPoint at = shape_functions(gauss_coordinates(g));
    const Matrix3d jacobian = x * at.by_xi;
    const double det = jacobian.determinant();
    if (!(det > 0))
      throw std::invalid_argument("element " + std::to_string(element) + " is inverted");
    const Matrix3d inverse = jacobian.inverse();
    entry(sum.points, g) = {to_tensor(inverse), det};
    sum.volume += det;
    sum.gradient += det * at.by_xi * inverse;
    sum.shares += det * at.shape;
  }
  sum.gradient /= sum.volume;
  return sum;
}

Vector3d mode_of(const Corners& x, int mode) {
  Vector3d sum = Vector3d::Zero();
  for (int i = 0; i < 8; ++i) sum += Shape::mode_sign(mode, i) * x.col(i);
  return sum;
}

Shape::Element::Plane plane_of(const Vector3d& j, const Vector3d& k) {
  Shape::Element::Plane plane;
  plane.ratio = j.norm() / k.norm();
  plane.inv_ratio = 1 / plane.ratio;
  plane.cosine = j.dot(k) / (j.norm() * k.norm());
  plane.inv_sine2 = 1 / (1 - plane.cosine * plane.cosine);
  plane.inv_sine = std::sqrt(plane.inv_sine2);
  return plane;
}

void set_fibres(Shape::Element& element, const Corners& x) {
  const Matrix3d half_edges = x * shape_functions(Vector3d::Zero()).by_xi;
  Matrix3d fibre;
  for (int i = 0; i < 3; ++i)
    fibre.row(i) = half_edges.col(i).transpose() / (8 * half_edges.col(i).squaredNorm());
  element.fibre = to_tensor(fibre);
  for (int a = 0; a < Shape::hourglasses; ++a)
    entry(element.natural, a) = to_point(fibre * mode_of(x, Shape::stretches + a));
  for (int k = 0; k < 3; ++k)
    entry(element.plane, k) = plane_of(half_edges.col((k + 1) % 3), half_edges.col((k + 2) % 3));
}

// Derivatives of the modes with respect to (xi, eta, zeta) at Gauss point g.
Eigen::Matrix<double, Shape::modes, 3> mode_derivatives(int g) {
  const AtPoint at = shape_functions(gauss_coordinates(g));
  Eigen::Matrix<double, Shape::modes, 3> sum = Eigen::Matrix<double, Shape::modes, 3>::Zero();
  for (int m = 0; m < Shape::modes; ++m)
    for (int i = 0; i < 8; ++i) sum.row(m) += Shape::mode_sign(m, i) * at.by_xi.row(i);
  return sum;
}

// At fixed mean gradient, hourglass modes X_m = fibre^-1 p_m add to it at a Gauss point, in the axes of the
// edges, sum p_m w_m: w_m fibre = (d_m - g_m . d)(dX/dxi)^-1/8 with d_m the mode's derivatives there, less the parts of
// the stretches that preserve the mean. Requires the gradients and fibres.
void set_hourglass_reach(Shape::Element& element, const Integrals& integrals) {
  using RowMajor = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
  Eigen::Matrix<double, Shape::modes, 3> mean;
  for (int m = 0; m < Shape::modes; ++m)
    for (int k = 0; k < 3; ++k) mean(m, k) = entry(entry(element.gradient, m), k);
  const Matrix3d edges = Eigen::Map<const RowMajor>(element.fibre.data()).inverse();
  const Eigen::Matrix<double, 4, 3> stretches = mean.bottomRows<4>() * mean.topRows<3>().inverse();
  for (int g = 0; g < 8; ++g) {
    const auto by = mode_derivatives(g);
    const Matrix3d inverse =
        Eigen::Map<const RowMajor>(entry(integrals.points, g).inverse_jacobian.data());
    const Eigen::Matrix<double, 4, 3> reach =
        (by.bottomRows<4>() - stretches * by.topRows<3>()) * inverse * edges / 8;
    const Eigen::SelfAdjointEigenSolver<Matrix3d> squares(reach.transpose() * reach);
    element.hourglass_reach2 = std::max(element.hourglass_reach2, squares.eigenvalues().maxCoeff());
  }
}

void set_gradients(Shape::Element& element, const Integrals& integrals) {
  for (int m = 0; m < Shape::modes; ++m) {
    Vector3d sum = Vector3d::Zero();
    for (int i = 0; i < 8; ++i)
      sum += Shape::mode_sign(m, i) * integrals.gradient.row(i).transpose();
    entry(element.gradient, m) = to_point(sum / 8);
  }
  Matrix3d spread = Matrix3d::Zero();
  for (int i = 0; i < 8; ++i)
    spread += integrals.volume / integrals.shares[i] * integrals.gradient.row(i).transpose() *
              integrals.gradient.row(i);
  element.spread = {spread(0, 0), spread(1, 1), spread(2, 2),
                    spread(0, 1), spread(1, 2), spread(2, 0)};
}

using Functions3 = Eigen::Matrix<double, 8, 3>;
using Functions4 = Eigen::Matrix<double, 8, 4>;

// The nodal weights of the hourglass strains, gamma_a = 1/8 (sign_a - sum_J sign_aJ x_J . b): zero for homogeneous
// deformations (Flanagan & Belytschko 1981).
Functions4 hourglass_functions(const Corners& x, const Functions3& gradient) {
  Functions4 gamma;
  for (int a = 0; a < Shape::hourglasses; ++a) {
    const int mode = Shape::stretches + a;
    gamma.col(a) = -gradient * mode_of(x, mode) / 8;
    for (int i = 0; i < 8; ++i) gamma(i, a) += Shape::mode_sign(mode, i) / 8;
  }
  return gamma;
}

// 2/3 of the largest inverse metric of the planes, doubled: a mode bends two plates.
double plate_spread(const Matrix3d& half_edges) {
  double largest = 0;
  for (int k = 0; k < 3; ++k) {
    Eigen::Matrix<double, 3, 2> plane;
    plane << half_edges.col((k + 1) % 3), half_edges.col((k + 2) % 3);
    const Eigen::Matrix2d inverse = (plane.transpose() * plane).inverse();
    const double half = inverse.trace() / 2;
    largest = std::max(largest, half + std::sqrt(half * half - inverse.determinant()));
  }
  return 2 * 2.0 / 3.0 * largest;
}

// Both kinds of modes, mass-weighted: how the lightest hourglass mode compares, and how strongly they overlap.
void set_hourglass_bounds(Shape::Element& element, const Corners& x, const Integrals& integrals) {
  const Eigen::Matrix<double, 8, 1> weight = (integrals.volume / integrals.shares.array()).sqrt();
  const Functions4 gamma = weight.asDiagonal() * hourglass_functions(x, integrals.gradient);
  const Functions3 b = weight.asDiagonal() * integrals.gradient;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> light(gamma.transpose() * gamma);
  const Matrix3d half_edges = x * shape_functions(Vector3d::Zero()).by_xi;
  element.hourglass_spread = light.eigenvalues().maxCoeff() * plate_spread(half_edges);
  // Between b and gamma, each orthonormalised by its Cholesky factor.
  const Eigen::Matrix<double, 4, 3> one_side =
      (gamma.transpose() * gamma).llt().matrixL().solve(gamma.transpose() * b);
  const Eigen::Matrix<double, 3, 4> cosines =
      (b.transpose() * b).llt().matrixL().solve(one_side.transpose());
  const Eigen::SelfAdjointEigenSolver<Matrix3d> overlap(cosines * cosines.transpose());
  element.overlap = std::max(0.0, overlap.eigenvalues().maxCoeff());
}

// The springs k K s of a face of area A on an element of volume V exert k K s (A/36) [4 2 1 2; ...] on its nodes,
// whose largest eigenvalue is that of all four moving together, a quarter of the sum. Here 1/4 V over the smallest mass.
double lightest_corner(const Shape& shape, const Shape::Face& face, const Integrals& integrals) {
  double least = integrals.volume;
  for (int i = 0; i < 8; ++i)
    for (const Row<BoundaryNode> node : face.corner)
      if (entry(entry(shape.hexahedra, face.element), i).value == node.value)
        least = std::min(least, integrals.shares[i]);
  return integrals.volume / (4 * least);
}

}  // namespace

void complete_elements(Shape& shape) {
  shape.element.clear();
  shape.gauss.clear();
  shape.nodal_volume.assign(shape.nodes.size(), 0);
  shape.volume = 0;
  std::vector<Integrals> all;
  for (int e = 0; e < shape.elements(); ++e) {
    const Corners x = corners_of(shape, e);
    const Integrals& integrals = all.emplace_back(integrals_of(x, e));
    Shape::Element& element = shape.element.emplace_back();
    element.volume = integrals.volume;
    set_gradients(element, integrals);
    set_fibres(element, x);
    set_hourglass_reach(element, integrals);
    set_hourglass_bounds(element, x, integrals);
    shape.gauss.push_back(integrals.points);
    for (int i = 0; i < 8; ++i)
      entry(shape.nodal_volume, entry(entry(shape.hexahedra, e), i)) += integrals.shares[i];
    shape.volume += integrals.volume;
  }
  for (const Shape::Face& face : shape.faces) {
    Shape::Element& element = entry(shape.element, face.element);
    const double corner = lightest_corner(shape, face, entry(all, face.element));
    element.contact_frequency += corner * face.stiffness / face.thickness;
    element.contact_drag += corner * std::sqrt(face.stiffness / face.thickness);
  }
  shape.chains = inerter_chains(shape);
}

}  // namespace pulvis::space
