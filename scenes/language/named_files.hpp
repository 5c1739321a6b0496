// The paths in a tree, found by their keys' kind.
#pragma once

#include <functional>

#include "scenes/language/schema.hpp"

namespace pulvis {

// Calls `use` for every path that is given, in the order of the tree. Empty ones, and what is no string, are
// left to the reader to refuse.
void for_each_path(document::Table& root, const schema::Language& language,
                   const std::function<void(schema::Kind, std::string&)>& use);

}  // namespace pulvis
