// Defaults of contact that depend on the scene.
#pragma once

#include "scenes/language/document.hpp"

namespace pulvis {

// The stiffness of the springs and what follows from it: that of friction and bonds, whether surfaces indent, inerters, and
// the estimate of the time step that these need.
void fill_contact(document::Table& root, int dimension);

}  // namespace pulvis
