// Where the names of the columns stand in a file that a data logger begins with lines of text.
//
// Safe is only this: the first two lines of numbers have as many fields, and right above them stands one line of as
// many names, or one with a short line of units below it.
#pragma once

#include <string>
#include <vector>

#include "scenes/language/csv_table.hpp"

namespace pulvis::csv {

struct HeaderSearch {
  std::size_t at = 0;   // of `lines`: the names of the columns
  std::string problem;  // why none is certain; then `at` is the line to look at
};

// `lines`: without those that are empty or comments. The first is the header unless another is certain to be.
HeaderSearch find_header(const std::vector<std::string_view>& lines);

char separator_of(std::string_view line);
std::vector<Cell> cells_of(std::string_view line, char separator);
bool could_be_number(const std::string& text);
// "force [N]" and "force (N)": a name, and a unit in brackets at its end.
Column column_of(const std::string& text);

}  // namespace pulvis::csv
