// Mesh resolution where a scene does not specify it: the scene's `accuracy`, justified by the measured error
// against run time in docs/accuracy.md.
#pragma once

#include "scenes/language/document.hpp"
#include "scenes/language/problem.hpp"

namespace pulvis {

// Writes the mesh of every particle that gives no mesh size into the tree. An `accuracy` that no particle
// uses is a problem.
void fill_meshes(document::Table& root, Problems& problems);

}  // namespace pulvis
