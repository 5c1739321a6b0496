// [let]: variables of a scene, and the values that are expressions of them. They are worked out before anything is
// read, so that the reader, the checks and the scene as it is kept know plain values alone.
#pragma once

#include "scenes/language/problem.hpp"
#include "scenes/language/schema.hpp"

namespace pulvis {

// Takes [let] out of the tree and writes its values where they are used. What is wrong is added to `problems`.
void apply_let(document::Table& root, const schema::Language& language, Problems& problems);

}  // namespace pulvis
