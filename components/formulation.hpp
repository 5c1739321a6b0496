// The element formulations of a scene: where an element's stresses stand, and what keeps its shape.
// All are four-node quads; the systems of the elements are templates of them.
#pragma once

#include <stdexcept>

namespace pulvis {

// 2x2 Gauss points, one dilatation for the whole element (mean dilatation).
struct FourPoint {
  static constexpr int points = 4;   // with a deviator and a plastic state each
  static constexpr int volumes = 1;  // with a mean stress each
  static constexpr bool stabilised = false;
};

// 2x2 Gauss points, each with its own dilatation. Locks where volume is kept: the negative control.
struct Standard {
  static constexpr int points = 4;
  static constexpr int volumes = 4;
  static constexpr bool stabilised = false;
};

// One point at the centre, and the two bending modes that it cannot see (systems/body/hourglass_kernel.hpp).
struct OnePoint {
  static constexpr int points = 1;
  static constexpr int volumes = 1;
  static constexpr bool stabilised = true;
};

enum class Formulation { four_point, one_point, standard };

// What a scene's formulation decides, decided here and nowhere else: visit(F{}), F the struct above.
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
