// How thin the elements are that surfaces could pass through within a step of the run.
#pragma once

#include "components/space/shape.hpp"

namespace pulvis::space {

// m: the least width of an element between opposite sides, at its middle.
double thinnest_part(const Shape& shape);

}  // namespace pulvis::space
