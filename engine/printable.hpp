// Makes text from a user or a file safe to print: a control character would be a command to the terminal.
#pragma once

#include <string>
#include <string_view>

namespace pulvis {

// Control characters (C0, DEL and C1) and bytes that are not valid UTF-8 are escaped: "\x1b".
std::string printable(std::string_view text);
std::string printable_lines(std::string_view text);  // for several lines: keeps line ends and tabs

}  // namespace pulvis
