// Text that a user or a file gave, fit to be shown: a control character would be an order to the terminal.
#pragma once

#include <string>
#include <string_view>

namespace pulvis {

// Control characters (of C0, DEL and C1) and bytes that are no UTF-8 are spelt out: "\x1b".
std::string printable(std::string_view text);
std::string printable_lines(std::string_view text);  // of several lines: line ends and tabs stay

}  // namespace pulvis
