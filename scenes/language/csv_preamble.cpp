#include "scenes/language/csv_preamble.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace pulvis::csv {
namespace {

constexpr std::size_t longest_unit = 8;  // characters

bool is_space(char c) { return c == ' ' || c == '\t'; }

std::string_view stripped(std::string_view text) {
  while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
  return text;
}

Cell cell_of(std::string_view line, std::size_t begin, std::size_t end) {
  std::string_view text = stripped(line.substr(begin, end - begin));
  const auto start = text.empty() ? begin : static_cast<std::size_t>(text.data() - line.data());
  if (text.size() >= 2 && text.front() == '"' && text.back() == '"')
    text = stripped(text.substr(1, text.size() - 2));
  return {std::string(text), static_cast<int>(start) + 1};
}

std::vector<Cell> fields_of(std::string_view line, char separator) {
  std::vector<Cell> cells = cells_of(line, separator);
  if (cells.size() > 1 && cells.back().text.empty()) cells.pop_back();
  return cells;
}

bool is_number_cell(const Cell& cell) { return could_be_number(cell.text); }
bool is_name(const Cell& cell) { return !cell.text.empty() && !is_number_cell(cell); }

// At least half of the fields are numbers.
bool are_numbers(const std::vector<Cell>& cells) {
  const auto numbers = std::ranges::count_if(cells, is_number_cell);
  const auto empty = std::ranges::count_if(cells, [](const Cell& c) { return c.text.empty(); });
  return numbers > 0 && 2 * numbers >= static_cast<std::ptrdiff_t>(cells.size()) - empty;
}

bool are_units(const std::vector<Cell>& cells) {
  return std::ranges::all_of(cells, [](const Cell& c) { return c.text.size() <= longest_unit; });
}

bool name_units(const std::vector<Cell>& cells) {
  return std::ranges::any_of(cells, [](const Cell& c) {
    const Column column = column_of(c.text);  // "[N]" alone belongs to a line of units
    return !column.name.empty() && !column.unit.empty();
  });
}

class Search {
 public:
  explicit Search(const std::vector<std::string_view>& lines) : lines_(lines) {}

  HeaderSearch run() {
    if (!find_numbers()) return {};
    std::vector<std::size_t> names;  // lines of names, from the numbers upwards
    for (std::size_t i = first_; i-- > 0 && of_names(i);) names.push_back(i);
    if (names.empty()) return without_names();
    if (names.back() == 1 && names.size() == 1 && fields(0).size() == fields_)
      return {};  // "2theta;I" above a line of units
    if (names.size() == 1 || name_units(fields(names[0]))) return {names[0], ""};
    if (names.back() == 0 && names.size() == 2) return {};  // names, and units of any kind
    if (names.size() == 2 && are_units(fields(names[0]))) return {names[1], ""};
    return {names.back(), "several lines could be the names of the columns"};
  }

 private:
  std::vector<Cell> fields(std::size_t i) const { return fields_of(lines_[i], separator_); }

  bool of_names(std::size_t i) const {
    const std::vector<Cell> cells = fields(i);
    return cells.size() == fields_ && std::ranges::all_of(cells, is_name);
  }

  // Two consecutive lines with equally many numbers.
  bool find_numbers() {
    for (first_ = 1; first_ + 1 < lines_.size(); ++first_) {
      separator_ = separator_of(lines_[first_]);
      const std::vector<Cell> one = fields(first_), two = fields(first_ + 1);
      fields_ = one.size();
      if (fields_ > 1 && fields_ == two.size() && are_numbers(one) && are_numbers(two)) return true;
    }
    return false;
  }

  // If the first line has as many fields it is the header, whatever it contains.
  HeaderSearch without_names() const {
    if (fields_of(lines_[0], separator_of(lines_[0])).size() == fields_) return {};
    if (first_ == 1) return {};  // the row is refused, with both counts
    return {first_ - 1,
            fmt::format("there are no names for the {} columns above the numbers", fields_)};
  }

  const std::vector<std::string_view>& lines_;
  std::size_t first_ = 1;   // line of numbers
  std::size_t fields_ = 0;  // fields per line
  char separator_ = ',';
};

}  // namespace

char separator_of(std::string_view header) {
  for (const char separator : {';', '\t'})
    if (header.find(separator) != std::string_view::npos) return separator;
  return ',';
}

std::vector<Cell> cells_of(std::string_view line, char separator) {
  std::vector<Cell> cells;
  bool quoted = false;
  std::size_t begin = 0;
  for (std::size_t i = 0; i <= line.size(); ++i) {
    if (i < line.size() && line[i] == '"') quoted = !quoted;
    if (i < line.size() && (quoted || line[i] != separator)) continue;
    cells.push_back(cell_of(line, begin, i));
    begin = i + 1;
  }
  return cells;
}

Column column_of(const std::string& text) {
  for (const char* pair : {"[]", "()"}) {
    const std::size_t open = text.rfind(pair[0]);
    if (open == std::string::npos || text.back() != pair[1]) continue;
    return {std::string(stripped(std::string_view(text).substr(0, open))),
            std::string(stripped(std::string_view(text).substr(open + 1, text.size() - open - 2)))};
  }
  return {text, ""};
}

bool could_be_number(const std::string& text) {
  const std::size_t first = text.find_first_not_of("+-.,");
  return first != std::string::npos && std::isdigit(static_cast<unsigned char>(text[first])) != 0;
}

HeaderSearch find_header(const std::vector<std::string_view>& lines) { return Search(lines).run(); }

}  // namespace pulvis::csv
