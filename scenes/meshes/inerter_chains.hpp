// Which nodes form the chains of a shape (components/inerter_chains.hpp).
#pragma once

#include "components/shape.hpp"
#include "components/space/shape.hpp"

namespace pulvis {

// Each boundary node with the nearest node that a side of an element leads to through the interior, and the next one in about the
// same direction, as far as they are free.
InerterChains inerter_chains(const Shape& shape);
InerterChains inerter_chains(const space::Shape& shape);

}  // namespace pulvis
