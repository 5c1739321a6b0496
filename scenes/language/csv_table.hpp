// Tables of numbers as text files: CSV as instruments, spreadsheets and Pulvis itself write it.
//
// Separators   comma, semicolon or tab, found from the header; a decimal comma where the separator is
//              no comma. One file has one decimal sign.
// Header       one line of column names, each with its unit: "force [N]" or "force (N)"; or the units
//              in a line of their own below it. Names are compared without regard to case.
// Preamble     lines of text before the header are left out where the header is certain (csv_preamble.hpp)
// Encoding     UTF-8; what is none is taken for Latin-1, whose µ, ° and ² are what units need
// Left out     empty lines and lines that start with '#'; spaces around fields; quotes around fields
//
// Cells stay text until numbers() asks for a column in an SI unit, so columns that nobody asks for may
// hold anything. What is wrong is thrown as SceneError: file:line:col: column: what, allowed: ...
#pragma once

#include "scenes/language/problem.hpp"

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace pulvis::csv {

// Beyond any quantity in SI units; products of a few of them are finite.
inline constexpr double largest_number = 1e30;

struct Column {
  std::string name;
  std::string unit;  // as written; empty: none is given
};

struct Cell {
  std::string text;
  int column = 1;  // where it starts in its line, in characters
};

struct Comment {
  std::string text;  // without its #
  int line = 0;
};

struct Table {
  std::filesystem::path file;
  int header_line = 0;  // of the file, from 1
  std::vector<Column> columns;
  std::vector<int> lines;  // of each row
  std::vector<std::vector<Cell>> rows;
  std::vector<Comment> comments;
  char decimal = '.';
};

struct Options {
  int header_line = 0;   // the line of the column names; 0: the first that is not left out
  bool has_key = false;  // the user can say it, by the key header_line
};

Table read(const std::filesystem::path& file, const Options& options = {});
Table read_text(std::string_view text, const std::filesystem::path& file,
                const Options& options = {});

bool has_column(const Table& table, const std::string& name);
std::size_t column_at(const Table& table, const std::string& name);  // refused where there is none

// Refuses a header with other columns than these, or with one of them twice.
void only(const Table& table, const std::vector<std::string>& names);

// Refuses columns of older tables with the new name: {{"forth", "trace"}, ...}.
void refuse_former(const Table& table,
                   const std::vector<std::pair<std::string, std::string>>& former_and_new);

// A column in the SI unit `unit`; "" for numbers without one. Every cell must hold a finite number,
// not beyond the largest.
std::vector<double> numbers(const Table& table, std::size_t column, const std::string& unit);

// The same for a column whose unit the caller has read: each number times `factor`.
std::vector<double> numbers(const Table& table, std::size_t column, double factor);

[[noreturn]] void refuse(const Table& table, const std::string& key, const std::string& message);
[[noreturn]] void refuse(const Table& table, const Comment& at, const std::string& message);
[[noreturn]] void refuse(const Table& table, std::size_t row, std::size_t column,
                         const std::string& message);

}  // namespace pulvis::csv
