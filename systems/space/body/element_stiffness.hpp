// The elements' part of highest_mode for hexahedra: elastic forces of systems/space/body/stiffness_kernel.hpp.
#pragma once

#include "components/space/formulation.hpp"
#include "systems/body/highest_mode.hpp"

namespace pulvis::space {

// Subtracts K v of an element, v and the forces in the columns of the mode.
void subtract_stiffness(const ModeBody<OnePoint>& body, Row<Element> e,
                        const ModeView<ThreeD>& mode);
void subtract_stiffness(const ModeBody<EightPoint>& body, Row<Element> e,
                        const ModeView<ThreeD>& mode);

}  // namespace pulvis::space
