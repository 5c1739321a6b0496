// Distribution of the nodal masses among the surrounding elements, for the bound on the time step.
#pragma once

#include "components/shape.hpp"

namespace pulvis {

// Fills corner_moment and contact_frequency of a shape with nodes, elements and measured edges. Any
// distribution gives a safe bound; this one keeps the highest frequency of the undeformed shape low.
void share_mass(Shape& shape);

}  // namespace pulvis
