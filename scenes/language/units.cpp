#include "scenes/language/units.hpp"

#include <fmt/format.h>
#include <udunits2.h>

#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <memory>
#include <mutex>

#include "engine/shortened.hpp"

namespace pulvis {
namespace {

struct FreeUnit {
  void operator()(ut_unit* unit) const { ut_free(unit); }
};
struct FreeConverter {
  void operator()(cv_converter* converter) const { cv_free(converter); }
};
using Unit = std::unique_ptr<ut_unit, FreeUnit>;
using Converter = std::unique_ptr<cv_converter, FreeConverter>;

// udunits' parser and its status are global, so every use holds this lock.
std::mutex& units_lock() {
  static std::mutex lock;
  return lock;
}

// Read once and kept until the program exits. The database has "degree" but not "deg".
ut_system* unit_system() {
  static ut_system* const system = [] {
    ut_set_error_message_handler(ut_ignore);
    ut_system* const read = ut_read_xml(nullptr);
    if (read == nullptr) throw std::runtime_error("the unit database of udunits2 cannot be read");
    const Unit degree(ut_get_unit_by_name(read, "degree"));
    ut_map_name_to_unit("deg", UT_ASCII, degree.get());
    return read;
  }();
  return system;
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_blank(char c) { return c == ' ' || c == '\t'; }

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

// Removes the number from the start of `text`, leaving the unit.
double take_number(std::string_view& text) {
  const std::string whole(text);
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  double value = 0;
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (status == std::errc::invalid_argument)
    throw UnitError(fmt::format("\"{}\" does not start with a number", shortened(whole)));
  if (status == std::errc::result_out_of_range)
    throw UnitError(fmt::format("the number of \"{}\" is outside the range of double precision",
                                shortened(whole)));
  if (!std::isfinite(value))
    throw UnitError(fmt::format("\"{}\" is not a finite number", shortened(whole)));
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return value;
}

// A digit may only belong to an exponent ("um^2", "kg m-3") or to a leading "1/": udunits reads any
// other number in a unit as a factor, and "m^-1.5" as 5/m.
bool hides_a_factor(std::string_view unit) {
  for (std::size_t i = 0; i < unit.size(); ++i) {
    if (!is_digit(unit[i])) continue;
    const bool leading_one = i == 0 && unit.starts_with("1/");
    const bool after_nothing = i == 0 || is_blank(unit[i - 1]);
    const char before = i == 0 ? ' ' : unit[i - 1];
    if (!leading_one && (after_nothing || before == '.' || before == '*' || before == '/'))
      return true;
  }
  return false;
}

Unit parse_unit(std::string_view text, std::string_view whole) {
  const std::string name(text);
  if (hides_a_factor(text))
    throw UnitError(fmt::format("the unit '{}' of \"{}\" contains a number", shortened(name),
                                shortened(whole)));
  Unit unit(ut_parse(unit_system(), name.c_str(), UT_UTF8));
  if (unit == nullptr)
    throw UnitError(fmt::format("unknown unit '{}' in \"{}\"", shortened(name), shortened(whole)));
  return unit;
}

// The base units of `unit` without its factor: "m-1.kg.s-2" for GPa. Unlike udunits' own comparison
// it keeps the radian, so that "10 Hz" is not an angular velocity. Empty: a plain number.
std::string dimension(const ut_unit* unit) {
  std::array<char, 256> buffer{};
  const int length = ut_format(unit, buffer.data(), buffer.size() - 1, UT_ASCII | UT_DEFINITION);
  if (length < 0) return "?";
  std::string text(buffer.data(), static_cast<std::size_t>(length));
  if (text.find_first_of("@(:") != std::string::npos) return "?";  // an offset or a logarithm
  const auto blank = text.find(' ');
  if (blank != std::string::npos) text.erase(0, blank + 1);
  return text == "1" ? std::string() : text;
}

// udunits raises prefixes to powers with the library's pow: 1e27 may differ in the last bit. If a few
// digits express the intended value, they are used.
double decimal(double factor) {
  constexpr double last_bits = 8 * std::numeric_limits<double>::epsilon();
  const std::string digits = fmt::format("{:.13e}", factor);
  double meant = factor;
  std::from_chars(digits.data(), digits.data() + digits.size(), meant);
  return std::abs(meant - factor) <= last_bits * std::abs(factor) ? meant : factor;
}

// Dividing by an integer rounds once where multiplying by 0.001 rounds twice: "15 mm" becomes
// the double nearest to 0.015, and lengths that are equal on paper are equal here.
double scaled(double value, double factor) {
  constexpr double equal = 1e-12;         // relative to the factor
  constexpr double largest_exact = 1e22;  // of the powers of ten
  const double whole = std::round(factor);
  if (whole >= 1 && std::abs(factor - whole) <= equal * factor) return value * decimal(whole);
  const double inverse = std::round(1 / factor);
  if (inverse >= 1 && inverse <= largest_exact && std::abs(1 / factor - inverse) <= equal * inverse)
    return value / decimal(inverse);
  return value * decimal(factor);
}

double converted(double value, ut_unit* given, const std::string& wanted, std::string_view whole) {
  const Unit target(ut_parse(unit_system(), wanted.c_str(), UT_UTF8));
  const std::string dimension_given = dimension(given);
  if (dimension_given != dimension(target.get()))
    throw UnitError(fmt::format("\"{}\" has the dimension of {}, {} is expected", shortened(whole),
                                dimension_given.empty() ? "a plain number" : dimension_given,
                                wanted));
  const Converter converter(ut_get_converter(given, target.get()));
  if (converter == nullptr)
    throw UnitError(fmt::format("\"{}\" cannot be converted to {}", shortened(whole), wanted));
  return scaled(value, cv_convert_double(converter.get(), 1.0));
}

}  // namespace

namespace {

// "0,5 mm": `rest` begins with the comma.
void refuse_decimal_comma(std::string_view whole, std::string_view rest) {
  if (rest.size() < 2 || rest.front() != ',' || !is_digit(rest[1])) return;
  const auto number = static_cast<std::size_t>(rest.data() - whole.data());
  std::size_t digits = 0;
  while (1 + digits < rest.size() && is_digit(rest[1 + digits])) ++digits;
  const std::string before(whole.substr(0, number)), after(rest.substr(1));
  throw UnitError(fmt::format(
      "\"{}\" has a comma in its number: write \"{}.{}\"{}", shortened(whole), before,
      shortened(after),
      digits == 3 && before != "0"
          ? fmt::format(", or \"{}{}\" if it separates thousands", before, shortened(after))
          : ""));
}

// The number at the start of `whole`; the rest is its unit.
double number_before(std::string_view whole, std::string_view& unit) {
  std::string_view rest = whole;
  const double number = take_number(rest);
  refuse_decimal_comma(whole, rest);
  unit = trimmed(rest);
  // The library's strings end there.
  if (unit.find('\0') != std::string_view::npos) throw UnitError("a quantity with a NUL character");
  return number;
}

}  // namespace

double parse_quantity(std::string_view text, const std::string& wanted) {
  const std::string_view whole = trimmed(text);
  std::string_view name;
  const double number = number_before(whole, name);
  if (name.empty())
    throw UnitError(
        fmt::format("missing unit: \"{}\" has none, {} is expected", shortened(whole), wanted));

  const std::scoped_lock lock(units_lock());
  const Unit unit = parse_unit(name, whole);
  const double value = converted(number, unit.get(), wanted, whole);
  if (!std::isfinite(value))
    throw UnitError(fmt::format("\"{}\" is outside the range of double precision in {}",
                                shortened(whole), wanted));
  return value;
}

BaseQuantity parse_any_quantity(std::string_view text) {
  const std::string_view whole = trimmed(text);
  std::string_view name;
  const double number = number_before(whole, name);
  if (name.empty()) return {number, ""};

  const std::scoped_lock lock(units_lock());
  const Unit unit = parse_unit(name, whole);
  const std::string base = dimension(unit.get());
  if (base == "?")
    throw UnitError(
        fmt::format("\"{}\" has a unit with an offset or a logarithm", shortened(whole)));
  const double value = converted(number, unit.get(), base.empty() ? "1" : base, whole);
  if (!std::isfinite(value))
    throw UnitError(fmt::format("\"{}\" is outside the range of double precision in SI units",
                                shortened(whole)));
  return {value, base};
}

}  // namespace pulvis
