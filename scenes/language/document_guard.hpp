// What a text must keep to before the TOML library sees it.
#pragma once

#include <string_view>

namespace pulvis::document {

// Refuses what the TOML library must not see: bytes that are no UTF-8, NUL, non-ASCII characters
// outside of strings and comments, and nesting deep enough to exhaust the stack.
void guard(std::string_view text);

}  // namespace pulvis::document
