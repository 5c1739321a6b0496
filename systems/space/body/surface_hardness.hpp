// For surface_hardness of hexahedra (systems/body/surface_hardness.hpp).
#pragma once

#include "systems/space/body/element_access.hpp"

namespace pulvis::space {

template <class Positions>
Lane dilatation_of(const Shape& shape, int element, const Positions& x) {
  const auto modes = element_modes(x, entry(shape.hexahedra, element));
  const auto f = kernels::deformation_gradient(modes, entry(shape.element, element).gradient);
  return kernels::determinant(f, kernels::adjugate(f));
}

}  // namespace pulvis::space
