// surface_hardness of quads.
#include "systems/body/surface_hardness.hpp"
#include "systems/body/element_access.hpp"

namespace pulvis {

template <class Positions>
Lane dilatation_of(const Shape& shape, int element, const Positions& x) {
  const auto map = quad_map<4>(x, entry(shape.quads, element));
  return determinant(map_gradient<1>(map, 0)) * (4 / entry(shape.centre, element)[0].determinant);
}
template struct surface_hardness<FourPoint>;
template struct surface_hardness<Standard>;
template struct surface_hardness<OnePoint>;

}  // namespace pulvis
