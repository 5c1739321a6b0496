// Keys of [[tool]] that say what relief a target surface has.
#pragma once

#include <vector>

#include "scenes/keys/declare.hpp"

namespace pulvis::schema {

std::vector<Key<ToolSpec>> profile_keys();

}  // namespace pulvis::schema
