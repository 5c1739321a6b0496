#include "scenes/packing/packing_table.hpp"

#include <fmt/format.h>

#include "scenes/language/problem.hpp"
#include "scenes/language/units.hpp"

namespace pulvis {

int class_named_in(const csv::Table& table, std::size_t row, std::size_t column,
                   const std::vector<std::string>& names) {
  const std::string& name = table.rows[row][column].text;
  const auto found = std::ranges::find(names, name);
  if (found == names.end())
    csv::refuse(table, row, column,
                fmt::format("no particle is called '{}'{}, allowed: {}", name,
                            suggestion(name, names), listed(names)));
  return static_cast<int>(found - names.begin());
}

std::vector<double> scales_in(const csv::Table& table) {
  if (!csv::has_column(table, "scale")) return std::vector<double>(table.rows.size(), 1);
  const std::size_t column = csv::column_at(table, "scale");
  const std::vector<double> scale = csv::numbers(table, column, "");
  for (std::size_t i = 0; i < scale.size(); ++i)
    if (scale[i] < 1e-6 || scale[i] > 1e6)
      csv::refuse(table, i, column, fmt::format("{:g}, allowed: from 1e-06 to 1e+06", scale[i]));
  return scale;
}

std::optional<double> top_in(const csv::Table& table) {
  constexpr std::string_view key = "top:";
  for (const csv::Comment& comment : table.comments) {
    if (!comment.text.starts_with(key)) continue;
    try {
      return parse_quantity(comment.text.substr(key.size()), "m");
    } catch (const UnitError& error) {
      csv::refuse(table, comment,
                  fmt::format("{}, allowed: # top: and a quantity in m", error.what()));
    }
  }
  return std::nullopt;
}

}  // namespace pulvis
