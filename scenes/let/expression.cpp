#include "scenes/let/expression.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "engine/portable_math.hpp"
#include "engine/shortened.hpp"
#include "scenes/language/problem.hpp"
#include "scenes/let/tokens.hpp"

namespace pulvis::let {
namespace {

constexpr int deepest_brackets = 64;
const Dimension angle{{0, 0, 0, 0, 0, 0, 0, 1}};

double plain_of(const Quantity& quantity, std::string_view function) {
  if (quantity.dimension.plain()) return quantity.value;
  throw ExpressionError(
      fmt::format("{}({}): a plain number is expected", function, quantity.text()));
}

double angle_of(const Quantity& quantity, std::string_view function) {
  if (quantity.dimension.plain() || quantity.dimension == angle) return quantity.value;
  throw ExpressionError(fmt::format("{}({}): an angle is expected", function, quantity.text()));
}

using OfNumber = double (*)(double);

struct PlainFunction {
  std::string_view name;
  OfNumber apply;
};

double arc_sine(double x) { return portable::atan2(x, std::sqrt((1 - x) * (1 + x))); }

constexpr std::array<PlainFunction, 3> of_angles{
    {{"sin", portable::sin}, {"cos", portable::cos}, {"tan", portable::tan}}};
constexpr std::array<PlainFunction, 3> to_angles{
    {{"asin", arc_sine}, {"acos", portable::acos}, {"atan", portable::atan}}};
constexpr std::array<PlainFunction, 5> of_numbers{
    {{"exp", portable::exp},
     {"log", [](double x) { return x > 0 ? portable::log(x) : std::nan(""); }},
     {"floor", [](double x) { return std::floor(x); }},
     {"ceil", [](double x) { return std::ceil(x); }},
     {"round", [](double x) { return std::round(x); }}}};

template <std::size_t n>
OfNumber found_in(const std::array<PlainFunction, n>& list, std::string_view name) {
  const auto* const found = std::ranges::find(list, name, &PlainFunction::name);
  return found == list.end() ? nullptr : found->apply;
}

Quantity extreme(std::string_view name, const std::vector<Quantity>& given) {
  Quantity best = given.front();
  for (const Quantity& one : given) {
    if (!(one.dimension == best.dimension))
      throw ExpressionError(
          fmt::format("{} of {} and {}: the dimensions differ", name, best.text(), one.text()));
    if (name == "min" ? one.value < best.value : one.value > best.value) best = one;
  }
  return best;
}

Quantity call(std::string_view name, const std::vector<Quantity>& given) {
  if (name == "min" || name == "max") return extreme(name, given);
  if (given.size() != 1)
    throw ExpressionError(fmt::format("{} takes one value, {} are given", name, given.size()));
  const Quantity& x = given.front();
  if (name == "abs") return {std::abs(x.value), x.dimension};
  if (name == "sqrt") return {std::sqrt(x.value), Dimension{}.times(x.dimension, 0.5)};
  if (const OfNumber function = found_in(of_angles, name)) return {function(angle_of(x, name))};
  if (const OfNumber function = found_in(to_angles, name))
    return {function(plain_of(x, name)), angle};
  return {found_in(of_numbers, name)(plain_of(x, name))};
}

double whole_power(double base, int power) {
  double result = 1;
  for (int i = 0; i < std::abs(power); ++i) result *= base;
  return power < 0 ? 1 / result : result;
}

double power_of(double base, double power) {
  constexpr double multiplied_out = 16;
  if (power == std::round(power) && std::abs(power) <= multiplied_out)
    return whole_power(base, static_cast<int>(power));
  return power == 0.5 ? std::sqrt(base) : portable::pow(base, power);
}

Quantity raised(const Quantity& base, const Quantity& power) {
  if (!power.dimension.plain())
    throw ExpressionError(fmt::format("the exponent {} is not a plain number", power.text()));
  if (base.value < 0 && power.value != std::round(power.value))
    throw ExpressionError(
        fmt::format("{} cannot be raised to the power {}", base.text(), power.text()));
  return {power_of(base.value, power.value), Dimension{}.times(base.dimension, power.value)};
}

Quantity summed(const Quantity& a, const Quantity& b, bool plus) {
  if (!(a.dimension == b.dimension))
    throw ExpressionError(
        fmt::format("{} {} {}: the dimensions differ", a.text(), plus ? '+' : '-', b.text()));
  return {plus ? a.value + b.value : a.value - b.value, a.dimension};
}

class Parser {
 public:
  Parser(std::string_view text, const Variables& variables)
      : tokens_(tokens_of(
            text, [&](std::string_view name) { return variables.has(name) || is_function(name); })),
        variables_(variables) {}

  Quantity whole() {
    const Quantity result = sum();
    if (!ended())
      throw ExpressionError(
          fmt::format("'{}' where an operator is expected", shortened(here().text)));
    return result;
  }

 private:
  bool ended() const { return at_ == tokens_.size(); }
  const Token& here() const {
    if (ended()) throw ExpressionError("it ends where a value is expected");
    return tokens_[at_];
  }
  bool is_sign(std::string_view sign) const {
    return !ended() && here().kind == Token::Kind::sign && here().text == sign;
  }
  bool take(std::string_view sign) {
    const bool there = is_sign(sign);
    if (there) ++at_;
    return there;
  }
  void close() {
    if (!take(")")) throw ExpressionError("a bracket is not closed");
  }

  Quantity sum() {
    Quantity result = product();
    while (is_sign("+") || is_sign("-")) {
      const bool plus = take("+") || !take("-");
      result = summed(result, product(), plus);
    }
    return result;
  }

  Quantity product() {
    Quantity result = factor();
    while (is_sign("*") || is_sign("/")) {
      const bool times = take("*") || !take("/");
      const Quantity other = factor();
      result = {times ? result.value * other.value : result.value / other.value,
                result.dimension.times(other.dimension, times ? 1 : -1)};
    }
    return result;
  }

  Quantity factor() {
    if (++depth_ > deepest_brackets) throw ExpressionError("it is nested too deeply");
    Quantity result;
    if (take("-")) {
      result = factor();
      result.value = -result.value;
    } else if (take("+")) {
      result = factor();
    } else {
      result = value();
      if (take("^")) result = raised(result, factor());
    }
    --depth_;
    return result;
  }

  Quantity value() {
    const Token token = here();
    ++at_;
    if (token.kind == Token::Kind::number) return number(token);
    if (token.kind == Token::Kind::name) return named(token.text);
    if (token.text != "(")
      throw ExpressionError(fmt::format("'{}' where a value is expected", shortened(token.text)));
    const Quantity result = sum();
    close();
    return result;
  }

  Quantity number(const Token& token) const {
    try {
      return quantity_of(token.text);
    } catch (const ExpressionError& error) {
      if (!variables_.has(token.unit)) throw;
      throw ExpressionError(
          fmt::format("{}; a name after a number is read as a unit: write {}*{}", error.what(),
                      token.text.substr(0, token.text.find_first_of(" \t")), token.unit));
    }
  }

  Quantity named(std::string_view name) {
    if (take("(")) return called(name);
    if (variables_.has(name)) return variables_.value_of(name);
    if (name == "pi") return {std::numbers::pi};
    throw ExpressionError(unknown(name));
  }

  Quantity called(std::string_view name) {
    if (!is_function(name) || name == "pi")
      throw ExpressionError(fmt::format("there is no function '{}', allowed: {}", shortened(name),
                                        listed_functions()));
    std::vector<Quantity> given{sum()};
    while (take(",")) given.push_back(sum());
    close();
    return call(name, given);
  }

  std::string unknown(std::string_view name) const {
    if (is_function(name)) return fmt::format("an opening bracket is expected after {}", name);
    const std::string hint = suggestion(std::string(name), variables_.names());
    const std::string what = fmt::format(
        "no variable is called '{}'{}, allowed: {}", shortened(name), hint,
        variables_.names().empty() ? "none, as there is no [let]" : listed(variables_.names()));
    try {
      quantity_of(fmt::format("1 {}", name));
      return hint.empty() ? fmt::format("{}; for the unit write 1 {}", what, shortened(name))
                          : what;
    } catch (const ExpressionError&) {
      return what;
    }
  }

  std::vector<Token> tokens_;
  const Variables& variables_;
  std::size_t at_ = 0;
  int depth_ = 0;
};

}  // namespace

void Variables::add(const std::string& name) {
  names_.push_back(name);
  known_.insert(name);
}

bool is_function(std::string_view name) {
  constexpr std::array<std::string_view, 5> others{"pi", "sqrt", "abs", "min", "max"};
  return found_in(of_angles, name) != nullptr || found_in(to_angles, name) != nullptr ||
         found_in(of_numbers, name) != nullptr || std::ranges::find(others, name) != others.end();
}

std::string listed_functions() {
  return "sqrt, sin, cos, tan, asin, acos, atan, exp, log, abs, min, max, floor, ceil, round";
}

bool is_expression(std::string_view text, const Variables& variables) {
  const auto is_known = [&](std::string_view name) {
    return variables.has(name) || is_function(name);
  };
  try {
    const std::vector<Token> tokens = tokens_of(text, is_known);
    if (is_literal(tokens)) return false;
    const bool named = std::ranges::any_of(tokens, [&](const Token& token) {
      return token.kind == Token::Kind::name &&
             (!variables.names().empty() || is_known(token.text));
    });
    const bool signs = std::ranges::any_of(tokens, [](const Token& token) {
      return token.kind == Token::Kind::sign && token.text != ",";
    });
    return named || (signs && tokens.size() > 2);
  } catch (const ExpressionError&) {
    return std::ranges::any_of(words_of(text), [&](std::string_view word) {
      return variables.has(word) || is_function(word);
    });
  }
}

std::string product_meant(std::string_view text, const Variables& variables) {
  try {
    const std::vector<Token> tokens = tokens_of(text, [](std::string_view) { return false; });
    const std::string_view unit = tokens.empty() ? "" : tokens.back().unit;
    if (!is_literal(tokens) || !variables.has(unit)) return "";
    return fmt::format(
        "{}*{}", text.substr(0, text.find_last_not_of(" \t", text.rfind(unit) - 1) + 1), unit);
  } catch (const ExpressionError&) {
    return "";
  }
}

std::vector<std::string> variables_in(std::string_view text, const Variables& variables) {
  if (text.size() > longest_expression) return {};  // refused when it is evaluated
  std::set<std::string> found;
  try {
    const std::vector<Token> tokens = tokens_of(
        text, [&](std::string_view name) { return variables.has(name) || is_function(name); });
    for (const Token& token : tokens)
      if (token.kind == Token::Kind::name && variables.has(token.text)) found.emplace(token.text);
  } catch (const ExpressionError&) {
    return {};
  }
  return {found.begin(), found.end()};
}

Quantity value_of(std::string_view text, const Variables& variables) {
  if (text.size() > longest_expression)
    throw ExpressionError(
        fmt::format("it is too long, allowed: {} characters", longest_expression));
  const Quantity result = Parser(text, variables).whole();
  if (!std::isfinite(result.value)) throw ExpressionError("its value is not finite");
  return result;
}

}  // namespace pulvis::let
