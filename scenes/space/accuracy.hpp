// What a scene that does not say it gets: the meshes that `accuracy` stands for, and the stiffness of its contacts. What
// they are good for: docs/accuracy.md.
#pragma once

#include "scenes/language/problem.hpp"

namespace pulvis::space {

// Writes the counts of the meshes that do not say them themselves.
void fill_meshes(document::Table& root, Problems& problems);

// Ten where no material yields: surfaces that stay elastic bear pressures under which softer springs lose force.
void fill_contact_stiffness(document::Table& root);

}  // namespace pulvis::space
