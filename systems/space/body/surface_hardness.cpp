// surface_hardness of hexahedra.
#include "systems/space/body/surface_hardness.hpp"
#include "components/space/formulation.hpp"
#include "systems/body/surface_hardness.hpp"

namespace pulvis {

template struct surface_hardness<space::OnePoint>;
template struct surface_hardness<space::EightPoint>;

}  // namespace pulvis
