// Dealing out the nodes' masses among the elements around them, for the bound of the time step.
#pragma once

#include "components/shape.hpp"

namespace pulvis {

// Fills corner_moment and contact_frequency of a shape with nodes, elements and measured edges. Any
// dealing-out gives a safe bound; this one makes the highest frequency of the undeformed shape small.
void share_mass(Shape& shape);

}  // namespace pulvis
