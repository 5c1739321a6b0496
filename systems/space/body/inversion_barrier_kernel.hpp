// Barrier against inversion of the one-point hexahedron at a corner, which its mean gradient cannot detect: plastic
// bending carries no more than its limit, however far a corner collapses.
//
// Source   as in two dimensions (docs/theory.md, section 4). Evaluated at the 2 x 2 x 2 Gauss points, which are not
//          inverted in any mesh (complete_elements rejects others), while corners in the mesh of a ball may be flat
// Symbols  r   det F at a Gauss point over the determinant of the mean gradient; 1 in every homogeneous deformation
//          p   components of the hourglass modes, systems/space/body/hourglass_kernel.hpp
// Energy   per undeformed volume: sum over the points with r < 0.3 of mu/8 (r + 0.3^2/r - 0.6)
// Bound    F^-1 F_g = 1 + E_g, E_g linear in p and, in the axes of the edges, |E_g| <= hourglass_reach |p|. With the
//          singular values s_i of E_g, r >= (1 - s_1)(1 - s_2)(1 - s_3) (Weyl 1949) >= (1 - |E_g|/sqrt 3)^3: above 0.3
//          if |E_g|^2 < 3 (1 - 0.3^(1/3))^2
#pragma once

#include "systems/body/hourglass_kernel.hpp"
#include "systems/space/body/hourglass_kernel.hpp"

namespace pulvis::space::kernels {

using pulvis::kernels::barrier_ratio;

inline constexpr double harmless_distortion2 = 0.3278;  // 3 (1 - 0.3^(1/3))^2, rounded down

// |p|^2 relative to the harmless limit: from 1 on, a corner may be inverting.
template <class T>
T closing_measure(const HourglassComponents<T>& p, const Shape::Element& element) {
  const auto add = [](const Vector3<T>& a, T sum) {
    return fma(a.x, a.x, fma(a.y, a.y, fma(a.z, a.z, sum)));
  };
  const T norm2 =
      add(p.ez, p.zx.x * p.zx.x) + add(p.xe, p.zx.y * p.zx.y) + add(p.xez, p.zx.z * p.zx.z);
  return (element.hourglass_reach2 * (1 / harmless_distortion2)) * norm2;
}

using GaussPoints = std::array<Shape::GaussPoint, 8>;

template <class T>
std::array<T, 8> gauss_determinants(const ElementModes<T>& modes, const GaussPoints& points) {
  std::array<T, 8> j;
  for (int g = 0; g < 8; ++g) {
    const auto f = point_gradient(modes, entry(points, g).inverse_jacobian, gauss_coordinates(g));
    entry(j, g) = determinant(f, adjugate(f));
  }
  return j;
}
// A NaN that comes later is kept.
template <class T>
T least_of(const std::array<T, 8>& values) {
  T least = values[0];
  for (int g = 1; g < 8; ++g) least = min(least, entry(values, g));
  return least;
}

// Per undeformed volume. `inv_j`: 1/det F of the mean gradient.
template <class T>
T inversion_barrier_energy(const std::array<T, 8>& determinants, T inv_j, T mu) {
  T sum{};
  for (const T& j : determinants) {
    const T r = j * inv_j;
    sum +=
        select(r < barrier_ratio, r + barrier_ratio * barrier_ratio / r - 2 * barrier_ratio, T{});
  }
  return 0.125 * (mu * sum);
}

// Adds by * cof(F), adj = cof(F)^T, row by row.
template <class T, class Add>
void each_cofactor_row(const Matrix3<T>& adj, T by, const Add& add) {
  add(0, Vector3<T>{by * adj.xx, by * adj.yx, by * adj.zx});
  add(1, Vector3<T>{by * adj.xy, by * adj.yy, by * adj.zy});
  add(2, Vector3<T>{by * adj.xz, by * adj.yz, by * adj.zz});
}

template <class T>
struct InversionBarrier {
  std::array<Modes<T>, 3> force{};  // derivatives of the energy with respect to x_m
  T least;                          // minimum det F over the Gauss points
};

// Derivative of the energy: dr = (cof F_g : dF_g)/J - r (cof F : dF)/J. `f`: mean gradient.
template <class T>
InversionBarrier<T> inversion_barrier(const ElementModes<T>& modes, const GaussPoints& points,
                                      const Shape::Element& element, T mu) {
  const auto adj = adjugate(deformation_gradient(modes, element.gradient));
  const T inv_j = 1.0 / determinant(deformation_gradient(modes, element.gradient), adj);
  const T scale = (0.125 * element.volume) * (mu * inv_j);
  InversionBarrier<T> barrier;
  T of_mean{};
  barrier.least = T{} + 1e300;
  for (int g = 0; g < 8; ++g) {
    const Tensor& inverse = entry(points, g).inverse_jacobian;
    const auto f = point_gradient(modes, inverse, gauss_coordinates(g));
    const auto adj_g = adjugate(f);
    const T j = determinant(f, adj_g), r = j * inv_j;
    const T slope = scale * min(1.0 - barrier_ratio * barrier_ratio / (r * r), T{});
    each_cofactor_row(adj_g, slope, [&](int k, const Vector3<T>& row) {
      add_point_force(entry(barrier.force, k), row, inverse, gauss_coordinates(g));
    });
    of_mean = fma(-slope, r, of_mean);
    barrier.least = min(barrier.least, j);
  }
  each_cofactor_row(adj, of_mean, [&](int k, const Vector3<T>& row) {
    add_gradient_force(entry(barrier.force, k), row, element.gradient);
  });
  return barrier;
}

}  // namespace pulvis::space::kernels
