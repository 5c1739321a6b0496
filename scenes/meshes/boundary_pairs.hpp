// Which nodes form the pairs of a shape (components/boundary_pairs.hpp).
#pragma once

#include "components/shape.hpp"
#include "components/space/shape.hpp"

namespace pulvis {

// Each boundary node with the nearest node that a side of an element leads to through the interior, if that one is free.
BoundaryPairs boundary_pairs(const Shape& shape);
BoundaryPairs boundary_pairs(const space::Shape& shape);

}  // namespace pulvis
