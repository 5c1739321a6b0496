// Finds the column names in a file in which a data logger has written lines of text first.
//
// Certain only if the first two lines of numbers have equally many fields, and directly above them is one line of
// as many names, or one followed by a short line of units.
#pragma once

#include <string>
#include <vector>

#include "scenes/language/csv_table.hpp"

namespace pulvis::csv {

struct HeaderSearch {
  std::size_t at = 0;   // index into `lines`: the column names
  std::string problem;  // why no header is certain; then `at` is the line in question
};

// `lines`: without empty lines and comments. The first is the header unless another one certainly is.
HeaderSearch find_header(const std::vector<std::string_view>& lines);

char separator_of(std::string_view line);
std::vector<Cell> cells_of(std::string_view line, char separator);
bool could_be_number(const std::string& text);
// "force [N]" and "force (N)": a name followed by a unit in brackets.
Column column_of(const std::string& text);

}  // namespace pulvis::csv
