// Tables of numbers as text files: CSV as written by instruments, spreadsheets and Pulvis itself.
//
// Separators   comma, semicolon or tab, detected from the header; a decimal comma if the separator is
//              not a comma. One file has one decimal sign.
// Header       one line of column names, each with its unit: "force [N]" or "force (N)"; or the units
//              on a separate line below it. Names are compared case-insensitively.
// Preamble     lines of text before the header are skipped if the header is certain (csv_preamble.hpp)
// Encoding     UTF-8; anything else is read as Latin-1, whose µ, ° and ² occur in units
// Ignored      empty lines and lines that start with '#'; spaces around fields; quotes around fields
//
// Cells stay text until numbers() requests a column in an SI unit, so unused columns may
// hold anything. Errors are thrown as SceneError: file:line:col: column: what, allowed: ...
#pragma once

#include "scenes/language/problem.hpp"

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace pulvis::csv {

// Larger than any quantity in SI units; products of a few such values remain finite.
inline constexpr double largest_number = 1e30;

struct Column {
  std::string name;
  std::string unit;  // as written; empty: none given
};

struct Cell {
  std::string text;
  int column = 1;  // where it starts in its line, in characters
};

struct Comment {
  std::string text;  // without the #
  int line = 0;
};

struct Table {
  std::filesystem::path file;
  int header_line = 0;  // line number in the file, from 1
  std::vector<Column> columns;
  std::vector<int> lines;  // of each row
  std::vector<std::vector<Cell>> rows;
  std::vector<Comment> comments;
  char decimal = '.';
};

struct Options {
  int header_line = 0;   // line number of the column names; 0: the first line that is not ignored
  bool has_key = false;  // the user can set it, with the key header_line
};

Table read(const std::filesystem::path& file, const Options& options = {});
Table read_text(std::string_view text, const std::filesystem::path& file,
                const Options& options = {});

bool has_column(const Table& table, const std::string& name);
std::size_t column_at(const Table& table, const std::string& name);  // throws if there is none

// Refuses a header with any other column, or with one of these twice.
void only(const Table& table, const std::vector<std::string>& names);

// Refuses columns of older tables and gives the new name: {{"forth", "trace"}, ...}.
void refuse_former(const Table& table,
                   const std::vector<std::pair<std::string, std::string>>& former_and_new);

// Leaves out the rows that have no value in this column.
Table with_value(Table table, std::size_t column);

// A column in the SI unit `unit`; "" for dimensionless numbers. Every cell must hold a finite number
// that does not exceed the largest.
std::vector<double> numbers(const Table& table, std::size_t column, const std::string& unit);

// The same for a column whose unit the caller has parsed: each number times `factor`.
std::vector<double> numbers(const Table& table, std::size_t column, double factor);

[[noreturn]] void refuse(const Table& table, const std::string& key, const std::string& message);
[[noreturn]] void refuse(const Table& table, const Comment& at, const std::string& message);
[[noreturn]] void refuse(const Table& table, std::size_t row, std::size_t column,
                         const std::string& message);

}  // namespace pulvis::csv
