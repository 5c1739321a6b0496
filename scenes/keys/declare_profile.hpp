// Keys of [[tool]] that define the relief of a target surface.
#pragma once

#include <vector>

#include "scenes/keys/declare.hpp"

namespace pulvis::schema {

std::vector<Key<ToolSpec>> profile_keys();

}  // namespace pulvis::schema
