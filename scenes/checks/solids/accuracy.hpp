// Defaults that depend on the scene: the meshes that `accuracy` stands for. Their accuracy:
// docs/accuracy.md.
#pragma once

#include "scenes/language/problem.hpp"

namespace pulvis::space {

// Writes the element counts of meshes that do not give them.
void fill_meshes(document::Table& root, Problems& problems);

}  // namespace pulvis::space
