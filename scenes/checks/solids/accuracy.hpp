// Defaults that depend on the scene: the meshes that `accuracy` stands for, and the contact stiffness. Their accuracy:
// docs/accuracy.md.
#pragma once

#include "scenes/language/problem.hpp"

namespace pulvis::space {

// Writes the element counts of meshes that do not give them.
void fill_meshes(document::Table& root, Problems& problems);

// Ten if no material yields: surfaces that stay elastic bear pressures at which softer springs underestimate the force.
void fill_contact_stiffness(document::Table& root);

}  // namespace pulvis::space
