// The element formulations of a scene in three dimensions. Both are 8-node hexahedra; the systems of the elements are
// templates of them.
#pragma once

#include <stdexcept>

#include "components/formulation.hpp"

namespace pulvis::space {

// One point, with the mean gradient of the element, and the twelve modes that it cannot see
// (systems/space/body/hourglass_kernel.hpp).
struct OnePoint {
  static constexpr int points = 1;  // with a deviator and a plastic state each
  static constexpr bool stabilised = true;
};

// 2 x 2 x 2 Gauss points, one dilatation for the whole element (mean dilatation): the reference.
struct EightPoint {
  static constexpr int points = 8;
  static constexpr bool stabilised = false;
};

// What a scene's formulation decides: visit(F{}), F the struct above. four_point, full integration in two dimensions,
// stands for eight.
template <class Visit>
decltype(auto) with_hexahedra(Formulation formulation, const Visit& visit) {
  switch (formulation) {
    case Formulation::one_point:
      return visit(OnePoint{});
    case Formulation::four_point:
      return visit(EightPoint{});
    case Formulation::standard:
      break;
  }
  throw std::logic_error("no such element formulation in three dimensions");
}

}  // namespace pulvis::space
