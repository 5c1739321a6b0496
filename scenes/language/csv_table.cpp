#include "scenes/language/csv_table.hpp"

#include "scenes/language/csv_preamble.hpp"
#include "scenes/language/encoding.hpp"
#include "scenes/language/units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

#include "engine/files/input_file.hpp"
#include "engine/shortened.hpp"

namespace pulvis::csv {
namespace {

constexpr std::size_t largest_file = 256U << 20U;  // bytes
constexpr std::size_t longest_shown = 40;          // characters of a cell in a message

bool is_blank(char c) { return c == ' ' || c == '\t'; }

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

[[noreturn]] void refuse_at(const std::filesystem::path& file, int line, int column,
                            const std::string& key, const std::string& message) {
  throw SceneError({{file.string(), line, column, "", key, message}});
}

std::string text_of(const std::filesystem::path& file) {
  try {
    return text_of_input(file, largest_file);
  } catch (const UnfitInput& unfit) {
    refuse_at(file, 1, 1, "table",
              fmt::format("{}, allowed: a table of numbers (CSV)", unfit.what()));
  }
}

struct Line {
  std::string_view text;
  int number = 0;
};

std::vector<Line> lines_of(std::string_view text, const std::filesystem::path& file) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);  // a byte order mark
  std::vector<Line> lines;
  for (int number = 1; !text.empty(); ++number) {
    const std::size_t end = text.find_first_of("\r\n");
    lines.push_back({text.substr(0, end), number});
    const std::size_t nul = lines.back().text.find('\0');
    if (nul != std::string_view::npos)
      refuse_at(file, number, static_cast<int>(nul) + 1, "table", "a NUL byte, allowed: text");
    const bool two = end != std::string_view::npos && text.substr(end, 2) == "\r\n";
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + (two ? 2 : 1));
  }
  return lines;
}

bool is_left_out(std::string_view line) {
  const std::string_view content = trimmed(line);
  return content.empty() || content.front() == '#';
}

bool holds_no_number(const std::vector<Cell>& cells) {
  return std::none_of(cells.begin(), cells.end(),
                      [](const Cell& cell) { return could_be_number(cell.text); });
}

class Reader {
 public:
  Reader(std::string_view text, const std::filesystem::path& file, const Options& options)
      : lines_(lines_of(text, file)), has_key_(options.has_key) {
    table_.file = file;
    table_.header_line = options.header_line;
  }

  Table read() {
    for (const Line& line : lines_)
      if (const std::string_view text = trimmed(line.text); text.starts_with('#'))
        table_.comments.push_back({std::string(trimmed(text.substr(1))), line.number});
    std::size_t next = header();
    next = units(next);
    for (; next < lines_.size(); ++next)
      if (!is_left_out(lines_[next].text)) row(lines_[next]);
    if (table_.rows.empty())
      refuse_at(table_.file, table_.header_line, 1, "table",
                "has no rows, allowed: a line of column names and lines of numbers");
    find_decimal();
    return std::move(table_);
  }

 private:
  std::size_t header() {
    std::size_t at = 0;
    if (table_.header_line > 0)
      at = static_cast<std::size_t>(table_.header_line) - 1;
    else
      at = found_header();
    if (at >= lines_.size())
      refuse_at(
          table_.file, 1, 1, "table",
          table_.header_line > 0
              ? fmt::format("has no line {}, allowed: the number of the line with the column names",
                            table_.header_line)
              : "is empty, allowed: a line of column names and lines of numbers");
    table_.header_line = lines_[at].number;
    separator_ = separator_of(lines_[at].text);
    std::vector<Cell> cells = cells_of(lines_[at].text, separator_);
    if (cells.back().text.empty()) cells.pop_back();  // a separator at the end of each line
    for (const Cell& cell : cells) table_.columns.push_back(column_of(cell.text));
    return at + 1;
  }

  // The first line that is not ignored, or the one below a preamble.
  std::size_t found_header() const {
    std::vector<std::size_t> numbers;
    std::vector<std::string_view> texts;
    constexpr std::size_t deepest = 1000;  // of a preamble
    for (std::size_t i = 0; i < lines_.size() && texts.size() < deepest; ++i) {
      if (is_left_out(lines_[i].text)) continue;
      numbers.push_back(i);
      texts.push_back(lines_[i].text);
    }
    if (texts.empty()) return lines_.size();
    const HeaderSearch found = find_header(texts);
    if (!found.problem.empty())
      refuse_at(
          table_.file, lines_[numbers[found.at]].number, 1, "table",
          fmt::format("{}, below lines of text at the start of the file; allowed: one line of "
                      "names, {}'#' before each line of text",
                      found.problem,
                      has_key_ ? "the key header_line = its number in the file, or " : "or "));
    return numbers[found.at];
  }

  // A line that contains only units, if the names have none.
  std::size_t units(std::size_t next) {
    while (next < lines_.size() && is_left_out(lines_[next].text)) ++next;
    const bool named = std::any_of(table_.columns.begin(), table_.columns.end(),
                                   [](const Column& column) { return !column.unit.empty(); });
    if (next >= lines_.size() || named) return next;
    const std::vector<Cell> cells = cells_of(lines_[next].text, separator_);
    if (cells.size() < table_.columns.size() || !holds_no_number(cells)) return next;
    for (std::size_t i = 0; i < table_.columns.size(); ++i) {
      const Column bare = column_of(cells[i].text);  // "[N]" is "N"
      table_.columns[i].unit = bare.unit.empty() ? bare.name : bare.unit;
    }
    return next + 1;
  }

  static std::string sign(char separator) {
    return separator == '\t' ? std::string("tab") : std::string(1, separator);
  }

  // Explains why a row has a different number of fields from the header.
  std::string explained(std::string_view line, std::size_t fields) const {
    const std::size_t wanted = table_.columns.size();
    const char other = separator_of(line);
    if (other != separator_ && cells_of(line, other).size() > 1)
      return fmt::format("; here the separator is '{}': use the same one in the whole file",
                         sign(other));
    if (separator_ == ',' && fields > wanted && fields <= 2 * wanted)
      return "; if the numbers have decimal commas (1,5), separate the columns by ';' or tabs";
    return "";
  }

  void row(const Line& line) {
    std::vector<Cell> cells = cells_of(line.text, separator_);
    const std::size_t wanted = table_.columns.size();
    if (cells.size() == wanted + 1 && cells.back().text.empty()) cells.pop_back();
    if (cells.size() != wanted)
      refuse_at(table_.file, line.number, 1, "row",
                fmt::format("has {} fields, allowed: {}, as many as the column names in line {} "
                            "(separator '{}'){}",
                            cells.size(), wanted, table_.header_line, sign(separator_),
                            explained(line.text, cells.size())));
    table_.lines.push_back(line.number);
    table_.rows.push_back(std::move(cells));
  }

  // The first cell that has a ',' or a '.' in a number decides for the file.
  void find_decimal() {
    if (separator_ == ',') return;
    for (const std::vector<Cell>& cells : table_.rows)
      for (const Cell& cell : cells) {
        if (!could_be_number(cell.text)) continue;
        const std::size_t sign = cell.text.find_first_of(".,");
        if (sign == std::string::npos) continue;
        table_.decimal = cell.text[sign];
        return;
      }
  }

  std::vector<Line> lines_;
  bool has_key_;
  char separator_ = ',';
  Table table_;
};

double number_in(const Table& table, std::size_t row, std::size_t column) {
  const Cell& cell = table.rows[row][column];
  if (cell.text.empty()) refuse(table, row, column, "no value, allowed: a number in every row");
  std::string text = cell.text;
  const char other = table.decimal == '.' ? ',' : '.';
  const bool mixed = text.find(other) != std::string::npos;
  std::replace(text.begin(), text.end(), table.decimal, '.');
  const char* begin = text.data() + (text.starts_with('+') ? 1 : 0);
  const char* end = text.data() + text.size();
  double value = 0;
  const auto read = std::from_chars(begin, end, value);
  if (mixed || read.ec != std::errc() || read.ptr != end || !std::isfinite(value))
    refuse(table, row, column,
           fmt::format("'{}' is not a finite number, allowed: digits with a decimal '{}' and no "
                       "other separators",
                       cell.text.substr(0, longest_shown), table.decimal));
  return value;
}

// One of the column's unit, expressed in the requested unit.
double factor_of(const Table& table, std::size_t column, const std::string& wanted) {
  const Column& own = table.columns[column];
  const bool is_plain = own.unit.empty() || own.unit == "-" || own.unit == "1";
  const std::string name = wanted.empty() ? "a plain number" : wanted;
  if (wanted.empty() && is_plain) return 1;
  if (own.unit.empty())
    refuse(table, own.name,
           fmt::format("has no unit, allowed: one that converts to {}, as in '{} [{}]'", name,
                       shortened(own.name), name));
  if (wanted.empty())
    refuse(table, own.name,
           fmt::format("has the unit '{}', allowed: a plain number", shortened(own.unit)));
  try {
    return parse_quantity("1 " + own.unit, wanted);
  } catch (const UnitError& error) {
    refuse(table, own.name,
           fmt::format("{}, allowed: a unit that converts to {}", error.what(), name));
  }
}

}  // namespace

Table read(const std::filesystem::path& file, const Options& options) {
  const std::string text = text_of(file);
  return read_text(text, file, options);
}

Table read_text(std::string_view text, const std::filesystem::path& file, const Options& options) {
  if (is_utf16(text))
    refuse_at(file, 1, 1, "table", "the file is UTF-16, allowed: text in UTF-8; save it as UTF-8");
  const std::string whole = as_utf8(std::string(text));
  return Reader(whole, file, options).read();
}

bool has_column(const Table& table, const std::string& name) {
  return std::any_of(table.columns.begin(), table.columns.end(),
                     [&](const Column& column) { return lower(column.name) == lower(name); });
}

std::size_t column_at(const Table& table, const std::string& name) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    if (lower(table.columns[i].name) == lower(name)) return i;
    names.push_back("'" + table.columns[i].name + "'");
  }
  refuse(table, name,
         fmt::format("there is no such column, allowed: one of the columns of the file: {}",
                     listed(names)));
}

void only(const Table& table, const std::vector<std::string>& names) {
  for (const Column& column : table.columns) {
    const auto same = [&](const std::string& name) { return lower(name) == lower(column.name); };
    if (std::none_of(names.begin(), names.end(), same))
      refuse(table, column.name, "the column is unknown, allowed: " + listed(names));
    if (std::count_if(table.columns.begin(), table.columns.end(),
                      [&](const Column& other) { return same(other.name); }) > 1)
      refuse(table, column.name, "the column occurs twice, allowed: each once");
  }
}

void refuse_former(const Table& table,
                   const std::vector<std::pair<std::string, std::string>>& former_and_new) {
  for (const auto& [former, name] : former_and_new)
    if (has_column(table, former))
      refuse(table, former, fmt::format("is called '{0}' now, allowed: {0}", name));
}

Table with_value(Table table, std::size_t column) {
  std::size_t kept = 0;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    if (table.rows[row][column].text.empty()) continue;
    std::swap(table.rows[kept], table.rows[row]);
    table.lines[kept++] = table.lines[row];
  }
  table.rows.resize(kept);
  table.lines.resize(kept);
  return table;
}

std::vector<double> numbers(const Table& table, std::size_t column, double factor) {
  std::vector<double> values;
  values.reserve(table.rows.size());
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    values.push_back(number_in(table, row, column) * factor);
    if (std::abs(values.back()) > largest_number)
      refuse(table, row, column,
             fmt::format("'{}' is {:g} in SI units, allowed: up to {:g}",
                         table.rows[row][column].text.substr(0, longest_shown), values.back(),
                         largest_number));
  }
  return values;
}

std::vector<double> numbers(const Table& table, std::size_t column, const std::string& unit) {
  return numbers(table, column, factor_of(table, column, unit));
}

void refuse(const Table& table, const std::string& key, const std::string& message) {
  refuse_at(table.file, table.header_line, 1, key, message);
}

void refuse(const Table& table, const Comment& at, const std::string& message) {
  refuse_at(table.file, at.line, 1, "comment", message);
}

void refuse(const Table& table, std::size_t row, std::size_t column, const std::string& message) {
  refuse_at(table.file, table.lines[row], table.rows[row][column].column,
            table.columns[column].name, message);
}

}  // namespace pulvis::csv
