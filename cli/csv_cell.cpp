#include "cli/csv_cell.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

namespace pulvis {
namespace {

// "-0.4 mm", "+1e-3 kg m^-2": a number with or without a unit, which cannot be a formula.
bool is_quantity(std::string_view text) {
  text.remove_prefix(1);
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc()) return false;
  const std::string_view unit(end, static_cast<std::size_t>(text.data() + text.size() - end));
  return unit.empty() || (unit[0] == ' ' && unit.find_first_of("+=@(|!,;\"'") == unit.npos);
}

bool is_formula(std::string_view text) {
  if (text.empty()) return false;
  const bool sign = text[0] == '+' || text[0] == '-';
  return sign ? !is_quantity(text) : std::string_view("=@\t\r").find(text[0]) != text.npos;
}

}  // namespace

std::string csv_cell(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
  std::string safe = "\"";
  for (const char c : text) {
    if (c == '"') safe += '"';
    safe += c;
  }
  return safe + "\"";
}

std::string csv_word(std::string_view text) {
  std::string word(text);
  if (is_formula(text)) word.insert(word.begin(), '\'');
  return csv_cell(word);
}

std::string csv_columns(const std::vector<CsvColumn>& columns) {
  std::string text;
  std::size_t rows = 0;
  for (const CsvColumn& column : columns) {
    if (!text.empty()) text += ',';
    text += csv_word(column.heading);
    rows = std::max(rows, column.values->size());
  }
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t i = 0; i < columns.size(); ++i) {
      text += i == 0 ? '\n' : ',';
      if (row < columns[i].values->size()) text += fmt::format("{:.9g}", (*columns[i].values)[row]);
    }
  }
  return text + "\n";
}

}  // namespace pulvis
