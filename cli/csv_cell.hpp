// Text as a cell of a CSV file.
#pragma once

#include <string>
#include <string_view>

namespace pulvis {

// As RFC 4180 has it: in quotes where it holds a separator, a quote or a line end.
std::string csv_cell(std::string_view text);
// The same of words that a user chose: behind an apostrophe where a spreadsheet would take them for a formula
// (= + - @ first), but not numbers and quantities.
std::string csv_word(std::string_view text);

}  // namespace pulvis
