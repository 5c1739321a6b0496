// Copies [die] into the packings and tools of a scene, so that its width is given in one place.
#pragma once

#include "scenes/language/document.hpp"
#include "scenes/language/problem.hpp"

namespace pulvis {

// Removes [die] from the tree. Anything missing or contradictory is added to `problems`.
void fill_die(document::Table& root, Problems& problems);

}  // namespace pulvis
