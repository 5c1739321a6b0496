// Text as a cell of a CSV file, and numbers as its columns.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace pulvis {

// As in RFC 4180: quoted if it contains a separator, a quote or a line end.
std::string csv_cell(std::string_view text);
// The same for text chosen by the user: prefixed with an apostrophe where a spreadsheet would read a formula
// (= + - @ first), except for numbers and quantities.
std::string csv_word(std::string_view text);

struct CsvColumn {
  std::string heading;
  const std::vector<double>* values;
};

// A table of numbers; shorter columns are padded with empty cells.
std::string csv_columns(const std::vector<CsvColumn>& columns);

}  // namespace pulvis
