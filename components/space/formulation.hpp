// The element formulations of a scene in three dimensions. Both are 8-node hexahedra; the element systems are
// templates on the formulation.
#pragma once

#include <stdexcept>

#include "components/formulation.hpp"

namespace pulvis::space {

// One point with the mean gradient of the element, and stabilisation of the twelve hourglass modes
// (systems/space/body/hourglass_kernel.hpp).
struct OnePoint {
  using Dimension = ThreeD;
  static constexpr int points = 1;   // each with its own deviator and plastic state
  static constexpr int volumes = 1;  // each with its own mean stress
  static constexpr bool stabilised = true;
};

// 2 x 2 x 2 Gauss points with one dilatation for the whole element (mean dilatation): the reference.
struct EightPoint {
  using Dimension = ThreeD;
  static constexpr int points = 8;
  static constexpr int volumes = 1;
  static constexpr bool stabilised = false;
};

// Maps a scene's formulation to a type: visit(F{}), F one of the structs above. four_point, full integration in
// two dimensions, means eight points here.
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
