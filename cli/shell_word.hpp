// Words of a command for the shell.
#pragma once

#include <string>

namespace pulvis {

// Quotes this text as one word of the shell.
std::string shell_word(const std::string& text);

}  // namespace pulvis
