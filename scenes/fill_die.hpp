// [die] put into the packings and tools of a scene: its width is given in one place.
#pragma once

#include "scenes/language/document.hpp"
#include "scenes/language/problem.hpp"

namespace pulvis {

// Takes [die] out of the tree. What is missing or contradicts it is added to `problems`.
void fill_die(document::Table& root, Problems& problems);

}  // namespace pulvis
