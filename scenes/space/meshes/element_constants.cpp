// Constants of hexahedra: mean gradients, fibres, masses.
//
// Source   mean gradient: Flanagan & Belytschko (1981). All integrands are of second degree at most in xi, eta and zeta,
//          or third for the masses: the 2 x 2 x 2 Gauss points integrate them exactly
#include "scenes/space/meshes/element_constants.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <stdexcept>

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
      throw std::invalid_argument("element " + std::to_string(element) + " is inside out");
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

// The springs k K A/V of a face of area A before an element of volume V bear k K A/V (A/36) [4 2 1 2; ...] on its nodes,
// whose largest eigenvalue is that of four moving together, a quarter of the sum.
double face_frequency(const Shape& shape, const Shape::Face& face, const Integrals& integrals) {
  double least = integrals.volume;
  for (int i = 0; i < 8; ++i)
    for (const Row<BoundaryNode> node : face.corner)
      if (entry(entry(shape.hexahedra, face.element), i).value == node.value)
        least = std::min(least, integrals.shares[i]);
  return face.stiffness * face.stiffness * integrals.volume / (4 * least);
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
    shape.gauss.push_back(integrals.points);
    for (int i = 0; i < 8; ++i)
      entry(shape.nodal_volume, entry(entry(shape.hexahedra, e), i)) += integrals.shares[i];
    shape.volume += integrals.volume;
  }
  for (const Shape::Face& face : shape.faces)
    entry(shape.element, face.element).contact_frequency +=
        face_frequency(shape, face, entry(all, face.element));
}

}  // namespace pulvis::space
