#include "scenes/let/dimension.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "scenes/language/units.hpp"

namespace pulvis::let {
namespace {

constexpr std::array<std::string_view, 8> base_units{"kg", "m", "s", "A", "K", "mol", "cd", "rad"};
constexpr double equal_powers = 1e-9;  // three times a third is one

// One factor of a dimension, such as "s-2".
void add_factor(Dimension& dimension, std::string_view factor) {
  const std::size_t end = std::min(factor.find_first_of("-0123456789"), factor.size());
  const auto* const base = std::ranges::find(base_units, factor.substr(0, end));
  if (base == base_units.end())
    throw ExpressionError(fmt::format("the unit {} is not an SI unit", factor));
  double power = 1;
  std::from_chars(factor.data() + end, factor.data() + factor.size(), power);
  dimension.powers.at(static_cast<std::size_t>(base - base_units.begin())) += power;
}

Dimension dimension_of(std::string_view text) {
  Dimension dimension;
  while (!text.empty()) {
    const std::size_t dot = std::min(text.find('.'), text.size());
    add_factor(dimension, text.substr(0, dot));
    text.remove_prefix(std::min(dot + 1, text.size()));
  }
  return dimension;
}

}  // namespace

bool Dimension::operator==(const Dimension& other) const {
  return std::ranges::equal(powers, other.powers,
                            [](double a, double b) { return std::abs(a - b) < equal_powers; });
}

Dimension Dimension::times(const Dimension& other, double power) const {
  Dimension product = *this;
  for (std::size_t i = 0; i < powers.size(); ++i) product.powers[i] += power * other.powers[i];
  return product;
}

std::string Dimension::text() const {
  std::string text;
  for (std::size_t i = 0; i < powers.size(); ++i) {
    if (std::abs(powers[i]) < equal_powers) continue;
    if (!text.empty()) text += '.';
    text += base_units[i];
    if (std::abs(powers[i] - 1) >= equal_powers) text += fmt::format("{:g}", powers[i]);
  }
  return text;
}

std::string Quantity::text() const {
  return dimension.plain() ? fmt::format("{:.6g}", value)
                           : fmt::format("{:.6g} {}", value, dimension.text());
}

Quantity quantity_of(std::string_view text) {
  try {
    const BaseQuantity base = parse_any_quantity(text);
    return {base.value, dimension_of(base.unit)};
  } catch (const UnitError& error) {
    throw ExpressionError(error.what());
  }
}

}  // namespace pulvis::let
