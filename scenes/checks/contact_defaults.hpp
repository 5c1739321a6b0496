// Defaults of contact that depend on the scene.
#pragma once

#include "scenes/language/document.hpp"

namespace pulvis {

// Contact springs follow their stiffness: how stiff those of friction are, inerters, and the
// estimate of the time step that these need.
void fill_contact(document::Table& root, int dimension);

}  // namespace pulvis
