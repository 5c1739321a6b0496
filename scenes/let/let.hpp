// [let]: variables of a scene, and values that are expressions of them. They are evaluated before anything else is
// read, so that the reader, the checks and the saved scene see plain values only.
#pragma once

#include "scenes/language/problem.hpp"
#include "scenes/language/schema.hpp"

namespace pulvis {

// Removes [let] from the tree and writes its values where they are used. Errors are added to `problems`.
void apply_let(document::Table& root, const schema::Language& language, Problems& problems);

}  // namespace pulvis
