// What both estimates of the stable time step of hexahedra have in common.
#pragma once

#include "systems/space/body/element_access.hpp"
#include "systems/space/body/inversion_barrier_kernel.hpp"

namespace pulvis::space {

// For a one-point element with a corner that may be inverting: the barrier stiffness scales with 1/r^3, r the least det F
// at a Gauss point over that at the centre. Found sufficient down to r = 0.2 (tests/systems/space/body/time_step_test.cpp);
// at most 25, so that a corner about to invert does so (and is reported) instead of driving the time step to zero.
template <class T>
T closing_factor(const kernels::ElementModes<T>& modes, const kernels::Matrix3<T>& f,
                 const Shape::Element& element, const kernels::GaussPoints& points) {
  const auto adj = kernels::adjugate(f);
  const T j = kernels::determinant(f, adj);
  const auto to = kernels::to_fibres(element.fibre, adj, 1.0 / j);
  const auto closing =
      kernels::closing_measure(kernels::hourglass_components(modes, to, element), element) >= 1.0;
  if (!any(closing)) return 1.0;
  const T least = kernels::least_of(kernels::gauss_determinants(modes, points));
  const T ratio = j / max(least, 1e-300);
  return select(closing, min(max(0.9 + 0.1 * (ratio * ratio * ratio), 1.0), 25.0), 1.0);
}

}  // namespace pulvis::space
