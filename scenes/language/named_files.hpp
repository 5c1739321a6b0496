// The file paths in a tree, found by the kind of their keys.
#pragma once

#include <functional>

#include "scenes/language/schema.hpp"

namespace pulvis {

// Calls `use` for every path that is given, in tree order. Empty paths and values that are not strings
// are left for the reader to refuse.
void for_each_path(document::Table& root, const schema::Language& language,
                   const std::function<void(schema::Kind, std::string&)>& use);

}  // namespace pulvis
