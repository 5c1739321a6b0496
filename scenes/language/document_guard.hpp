// Checks a text before the TOML library sees it.
#pragma once

#include <string_view>

namespace pulvis::document {

// Refuses what the TOML library cannot handle: bytes that are not UTF-8, NUL, non-ASCII characters
// outside strings and comments, and nesting deep enough to overflow the stack.
void guard(std::string_view text);

}  // namespace pulvis::document
