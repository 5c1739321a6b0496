#include "scenes/csv_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>

#include "scenes/problem.hpp"
#include "scenes/units.hpp"

namespace pulvis {
namespace {

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t\r");
  return first == std::string::npos
             ? ""
             : text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::vector<CsvCell> cells_of(const std::string& line, int number) {
  std::vector<CsvCell> cells;
  for (std::size_t begin = 0; begin <= line.size();) {
    const std::size_t end = std::min(line.find(',', begin), line.size());
    const std::string text = line.substr(begin, end - begin);
    const auto blanks = std::min(text.find_first_not_of(" \t"), text.size());
    cells.push_back({trimmed(text), number, static_cast<int>(begin + blanks) + 1});
    begin = end + 1;
  }
  return cells;
}

}  // namespace

CsvFile::CsvFile(const std::filesystem::path& file) : file_(file) {
  std::ifstream stream(file);
  if (!stream || std::filesystem::is_directory(file))
    refuse({"", 1, 1}, "there is no such file, allowed: a table (CSV)");
  std::string line;
  for (int number = 1; std::getline(stream, line); ++number) {
    const std::string text = trimmed(line);
    if (text.empty()) continue;
    if (text[0] == '#') {
      comments_.push_back({trimmed(text.substr(1)), number, 1});
    } else if (header_.empty()) {
      header_ = cells_of(line, number);
    } else {
      rows_.push_back(cells_of(line, number));
      if (rows_.back().size() != header_.size())
        refuse(rows_.back().front(), fmt::format("{} cells, allowed: {}, as the header has",
                                                 rows_.back().size(), header_.size()));
    }
  }
  if (rows_.empty()) refuse({"", 1, 1}, "is empty, allowed: a header and at least one row");
  for (CsvCell& name : header_) {
    const auto open = name.text.find('['), close = name.text.find(']');
    const bool has_unit = open != std::string::npos && close != std::string::npos && open < close;
    units_.push_back(has_unit ? trimmed(name.text.substr(open + 1, close - open - 1)) : "");
    if (has_unit) name.text = trimmed(name.text.substr(0, open));
  }
}

void CsvFile::refuse(const CsvCell& at, const std::string& message) const {
  throw SceneError({{file_.string(), at.line, at.column, "", "csv", message}});
}

int CsvFile::find(const std::string& name) const {
  const auto found = std::ranges::find(header_, name, &CsvCell::text);
  return found == header_.end() ? -1 : static_cast<int>(found - header_.begin());
}

void CsvFile::only(const std::vector<std::string>& names) const {
  for (const CsvCell& cell : header_)
    if (std::ranges::find(names, cell.text) == names.end() ||
        std::ranges::count(header_, cell.text, &CsvCell::text) > 1)
      refuse(cell, fmt::format("column '{}' is {}, allowed: {}", cell.text,
                               std::ranges::find(names, cell.text) == names.end() ? "unknown"
                                                                                  : "there twice",
                               listed(names)));
}

std::vector<CsvCell> CsvFile::texts(const std::string& name) const {
  const int column = find(name);
  if (column < 0)
    refuse(header_.front(), fmt::format("column '{}' is missing, allowed: a header with it", name));
  std::vector<CsvCell> cells;
  for (const auto& row : rows_) cells.push_back(row[static_cast<std::size_t>(column)]);
  return cells;
}

double CsvFile::factor(int column, const std::string& unit) const {
  const std::string& own = units_[static_cast<std::size_t>(column)];
  const CsvCell& head = header_[static_cast<std::size_t>(column)];
  if (unit.empty()) {
    if (own.empty()) return 1;
    refuse(head, fmt::format("'{}' has no unit, allowed: bare numbers", head.text));
  }
  if (own == unit) return 1;
  try {
    return parse_quantity("1 " + own, unit);
  } catch (const UnitError& error) {
    refuse(head, fmt::format("{}, allowed: '{} [{}]' or another unit of its dimension",
                             own.empty() ? "the unit is missing" : error.what(), head.text, unit));
  }
}

std::vector<double> CsvFile::numbers(const std::string& name, const std::string& unit) const {
  const std::vector<CsvCell> cells = texts(name);
  const double scale = factor(find(name), unit);
  std::vector<double> result;
  for (const CsvCell& cell : cells) {
    double number = 0;
    const char* end = cell.text.data() + cell.text.size();
    const auto [stop, error] = std::from_chars(cell.text.data(), end, number);
    if (error != std::errc() || stop != end || !std::isfinite(number))
      refuse(cell, fmt::format("'{}' is no number, allowed: a finite number", cell.text));
    result.push_back(scale == 1 ? number : scale * number);
  }
  return result;
}

}  // namespace pulvis
