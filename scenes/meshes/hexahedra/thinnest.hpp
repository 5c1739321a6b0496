// Thickness of the thinnest element: surfaces could pass through it within one step of the run.
#pragma once

#include "components/space/shape.hpp"

namespace pulvis::space {

// m: the minimum width of an element between opposite sides, at its centre.
double thinnest_part(const Shape& shape);

}  // namespace pulvis::space
