// Constants of an undeformed element that the systems of the bodies use.
#pragma once

#include "components/space/shape.hpp"

namespace pulvis::space {

// Fills element, gauss, nodal_volume and volume from nodes and hexahedra; contact frequencies from the faces, if there
// are any. Throws std::invalid_argument naming any element that is inverted at one of its Gauss points.
void complete_elements(Shape& shape);

}  // namespace pulvis::space
