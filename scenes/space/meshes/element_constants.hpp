// What the systems of the bodies keep of an undeformed element.
#pragma once

#include "components/space/shape.hpp"

namespace pulvis::space {

// Fills element, gauss, nodal_volume and volume from nodes and hexahedra; contact frequencies from the faces, when there
// are any. Throws std::invalid_argument naming an element that is inside out at one of its Gauss points.
void complete_elements(Shape& shape);

}  // namespace pulvis::space
