// The meshes that `accuracy` stands for. What they are good for: docs/accuracy.md.
#pragma once

#include "scenes/language/problem.hpp"

namespace pulvis::space {

// Writes the counts of the meshes that do not say them themselves.
void fill_meshes(document::Table& root, Problems& problems);

}  // namespace pulvis::space
