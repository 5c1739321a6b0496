// The element formulations of a scene: where stresses are evaluated, and how hourglassing is prevented.
// All are four-node quads; the element systems are templates on the formulation.
#pragma once

#include <stdexcept>

#include "components/dimension.hpp"

namespace pulvis {

// 2x2 Gauss points with one dilatation for the whole element (mean dilatation).
struct FourPoint {
  using Dimension = TwoD;
  static constexpr int points = 4;   // each with its own deviator and plastic state
  static constexpr int volumes = 1;  // each with its own mean stress
  static constexpr bool stabilised = false;
};

// 2x2 Gauss points, each with its own dilatation. Volumetric locking: the negative control.
struct Standard {
  using Dimension = TwoD;
  static constexpr int points = 4;
  static constexpr int volumes = 4;
  static constexpr bool stabilised = false;
};

// One point at the centre, with stabilised hourglass modes (systems/body/hourglass_kernel.hpp).
struct OnePoint {
  using Dimension = TwoD;
  static constexpr int points = 1;
  static constexpr int volumes = 1;
  static constexpr bool stabilised = true;
};

enum class Formulation { four_point, one_point, standard };

// The only place that maps a scene's formulation to a type: visit(F{}), F one of the structs above.
template <class Visit>
decltype(auto) with_formulation(Formulation formulation, const Visit& visit) {
  switch (formulation) {
    case Formulation::four_point:
      return visit(FourPoint{});
    case Formulation::one_point:
      return visit(OnePoint{});
    case Formulation::standard:
      return visit(Standard{});
  }
  throw std::logic_error("no such element formulation");
}

}  // namespace pulvis
