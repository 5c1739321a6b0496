// Text as a cell of a CSV file, and numbers as columns of one.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace pulvis {

// As RFC 4180 has it: in quotes where it holds a separator, a quote or a line end.
std::string csv_cell(std::string_view text);
// The same of words that a user chose: behind an apostrophe where a spreadsheet would take them for a formula
// (= + - @ first), but not numbers and quantities.
std::string csv_word(std::string_view text);

struct CsvColumn {
  std::string heading;
  const std::vector<double>* values;
};

// A table of numbers; columns of different length end in empty cells.
std::string csv_columns(const std::vector<CsvColumn>& columns);

}  // namespace pulvis
