#include "scenes/let/let.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "engine/shortened.hpp"
#include "scenes/language/units.hpp"
#include "scenes/let/expression.hpp"
#include "scenes/let/tokens.hpp"

namespace pulvis {
namespace {

using document::Entry;
using document::Table;
using document::Value;
using schema::KeyInfo;
using schema::Kind;

// The variables of a scene. Each is evaluated once, after those that it is defined by, without recursion: a chain may
// be as long as the file.
class Scope {
 public:
  Scope(const Table& table, Problems& problems) : problems_(problems) {
    for (const Entry& entry : table) add(entry);
    variables_.value_of = [this](std::string_view name) { return value_of(std::string(name)); };
  }

  const let::Variables& variables() const { return variables_; }

  // Evaluates all of them, used or not: each error is reported once, at its variable.
  void work_out() {
    for (const std::string& name : variables_.names()) work_out_chain(name);
    used_.clear();
  }

  // A mistyped name in an override would have no effect, and go unnoticed.
  void refuse_unused_overrides() {
    add_used_by_used();
    std::vector<std::string> used;
    for (const std::string& name : variables_.names())
      if (used_.contains(name)) used.push_back(name);
    for (const std::string& name : variables_.names()) {
      const document::Origin& origin = given_.at(name)->origin;
      if (origin.override_index < 0 || used_.contains(name)) continue;
      problems_.add(
          origin, "let." + name,
          fmt::format("no value uses this variable{}, allowed: {}", suggestion(name, used),
                      used.empty() ? "none, as no value of this scene does" : listed(used)));
    }
  }

 private:
  struct Told : let::ExpressionError {
    using let::ExpressionError::ExpressionError;
  };

  void add(const Entry& entry) {
    const std::string& name = entry.key;
    const std::vector<std::string_view> words = let::words_of(name);
    const bool one_word = words.size() == 1 && words.front() == name;
    if (!one_word || let::is_function(name)) {
      problems_.add(entry.origin, "let." + name,
                    fmt::format("is not a valid variable name, allowed: letters, digits and '_', a "
                                "letter first, and none of pi, {}",
                                let::listed_functions()));
      return;
    }
    variables_.add(name);
    given_[name] = &entry;
  }

  // Depth first, with a stack of its own.
  void work_out_chain(const std::string& first) {
    if (is_known(first)) return;
    std::vector<std::string> open{first};
    std::set<std::string> in_open{first};
    while (!open.empty()) {
      const std::string name = open.back();
      const std::vector<std::string>& parts = parts_of(name);
      const auto next = std::ranges::find_if_not(
          parts, [this](const std::string& part) { return is_known(part); });
      if (next != parts.end() && !in_open.contains(*next)) {
        open.push_back(*next);
        in_open.insert(*next);
        continue;
      }
      if (next != parts.end())
        refuse_circle(name, std::ranges::find(open, *next), open.end());
      else
        evaluate(name);
      open.pop_back();
      in_open.erase(name);
    }
  }

  bool is_known(const std::string& name) const {
    return values_.contains(name) || wrong_.contains(name);
  }

  // The variables in its definition.
  const std::vector<std::string>& parts_of(const std::string& name) {
    const auto [parts, fresh] = parts_.try_emplace(name);
    const auto* text = given_.at(name)->value.as<std::string>();
    if (fresh && text != nullptr) parts->second = let::variables_in(*text, variables_);
    return parts->second;
  }

  void refuse_circle(const std::string& name, std::vector<std::string>::const_iterator begin,
                     std::vector<std::string>::const_iterator end) {
    constexpr std::ptrdiff_t shown = 6;
    const std::string more = end - begin > shown ? "... -> " : "";
    refuse(name, fmt::format("is defined in terms of itself: {} -> {}{}, allowed: expressions of "
                             "other variables",
                             fmt::join(begin, begin + std::min(shown, end - begin), " -> "), more,
                             *begin));
  }

  void refuse(const std::string& name, const std::string& reason) {
    const Value& given = given_.at(name)->value;
    wrong_.insert(name);
    problems_.add(given.origin, "let." + name,
                  shortened(document::value_text(given)) + ": " + reason);
  }

  void evaluate(const std::string& name) {
    try {
      values_[name] = defined(given_.at(name)->value);
    } catch (const Told&) {  // the variable to blame has been reported
      wrong_.insert(name);
    } catch (const let::ExpressionError& error) {
      refuse(name, error.what());
    }
  }

  let::Quantity value_of(const std::string& name) {
    used_.insert(name);
    if (wrong_.contains(name)) throw Told(name);
    return values_.at(name);
  }

  void add_used_by_used() {
    std::vector<std::string> open(used_.begin(), used_.end());
    while (!open.empty()) {
      const std::string name = std::move(open.back());
      open.pop_back();
      for (const std::string& part : parts_of(name))
        if (used_.insert(part).second) open.push_back(part);
    }
  }

  let::Quantity defined(const Value& value) const {
    if (const auto* whole = value.as<std::int64_t>()) return {static_cast<double>(*whole)};
    const auto* number = value.as<double>();
    if (number != nullptr && std::isfinite(*number)) return {*number};
    if (const auto* text = value.as<std::string>()) return let::value_of(*text, variables_);
    throw let::ExpressionError(fmt::format(
        "{} is given, allowed: a number, a quantity or an expression",
        number != nullptr ? "a number that is not finite" : document::type_name(value)));
  }

  Problems& problems_;
  let::Variables variables_;
  std::map<std::string, const Entry*> given_;
  std::map<std::string, let::Quantity> values_;
  std::map<std::string, std::vector<std::string>> parts_;  // of the definition of each variable
  std::set<std::string> used_, wrong_;
};

// Writes the values of expressions into the tree.
class Replacement {
 public:
  Replacement(const let::Variables& variables, const schema::Language& language, Problems& problems)
      : variables_(variables), language_(language), problems_(problems) {}

  void in_table(Table& table, const std::string& declared, const std::string& path) const {
    const schema::TableView& view = *schema::find_table(declared, language_);
    for (Entry& entry : table) {
      const std::string entry_path = schema::joined_path(path, entry.key);
      if (const KeyInfo* key = schema::find_key(view, entry.key))
        in_value(*key, entry.value, entry_path);
      else
        below(entry.value, schema::joined_path(declared, entry.key), entry_path);
    }
  }

 private:
  void below(Value& value, const std::string& declared, const std::string& path) const {
    if (schema::find_table(declared, language_) == nullptr) return;
    if (auto* table = value.as<Table>()) in_table(*table, declared, path);
    if (!document::is_array_of_tables(value)) return;
    auto& elements = value.get<document::Array>();
    for (std::size_t i = 0; i < elements.size(); ++i)
      in_table(elements[i].get<Table>(), declared, fmt::format("{}[{}]", path, i));
  }

  static bool is_numeric(Kind kind) {
    switch (kind) {
      case Kind::quantity:
      case Kind::vector:
      case Kind::points:
      case Kind::phase:
      case Kind::number:
      case Kind::integer:
      case Kind::counts:
      case Kind::direction:
      case Kind::bound:
      case Kind::integers:
      case Kind::numbers:
        return true;
      default:
        return false;
    }
  }

  static bool is_word_of(const KeyInfo& key, const std::string& text) {
    return (key.kind == Kind::phase && text == key.word) ||
           std::ranges::find(key.choices, text, &schema::Choice::word) != key.choices.end();
  }

  void in_value(const KeyInfo& key, Value& value, const std::string& path) const {
    if (!is_numeric(key.kind)) return;
    if (auto* array = value.as<document::Array>())
      for (Value& element : *array) in_value(key, element, path);
    const auto* text = value.as<std::string>();
    if (text == nullptr || is_word_of(key, *text)) return;
    try {
      if (!let::is_expression(*text, variables_)) return refuse_missing_operator(key, *text);
      write(key, value, let::value_of(*text, variables_));
    } catch (const let::ExpressionError& error) {
      problems_.add(value.origin, path, fmt::format("\"{}\": {}", shortened(*text), error.what()));
    }
  }

  // "2 D", with D a variable, is read as a quantity with the unit D.
  void refuse_missing_operator(const KeyInfo& key, const std::string& text) const {
    const std::string product = let::product_meant(text, variables_);
    if (product.empty() || key.unit.empty()) return;
    try {
      parse_quantity(text, key.unit);
    } catch (const UnitError& error) {
      throw let::ExpressionError(fmt::format(
          "{}; a name after a number is read as a unit: write \"{}\"", error.what(), product));
    }
  }

  static void write(const KeyInfo& key, Value& value, const let::Quantity& found) {
    const std::string given = found.dimension.plain() ? "a plain number" : found.text();
    const let::Quantity wanted =
        key.unit.empty() ? let::Quantity{1} : let::quantity_of("1 " + key.unit);
    if (key.kind == Kind::bound) {
      if (found.dimension.plain())
        value.data = found.value;
      else
        value.data = fmt::format("{} {}", found.value, found.dimension.text());
      return;
    }
    if (!(found.dimension == wanted.dimension))
      throw let::ExpressionError(fmt::format(
          "is {}, allowed: {}", found.dimension.plain() ? found.text() + ", " + given : given,
          schema::allowed(key)));
    if (!key.unit.empty())
      value.data = fmt::format("{} {}", found.value / wanted.value, key.unit);
    else if (key.kind == Kind::integer || key.kind == Kind::integers || key.kind == Kind::counts)
      value.data = whole(key, found.value);
    else
      value.data = found.value;
  }

  // Integers within rounding; "floor(...)" and "round(...)" exist for other values.
  static std::int64_t whole(const KeyInfo& key, double value) {
    constexpr double rounding = 1e-9;
    constexpr double largest = 9e15;  // below it a double represents every integer exactly
    const double nearest = std::round(value);
    if (std::abs(value) > largest ||
        std::abs(value - nearest) > rounding * std::max(1.0, std::abs(value)))
      throw let::ExpressionError(fmt::format("is {}, allowed: {}; floor, ceil and round give one",
                                             value, schema::allowed(key)));
    return static_cast<std::int64_t>(nearest);
  }

  const let::Variables& variables_;
  const schema::Language& language_;
  Problems& problems_;
};

}  // namespace

void apply_let(Table& root, const schema::Language& language, Problems& problems) {
  Table variables;
  if (const Entry* entry = document::find(root, "let")) {
    if (const auto* table = entry->value.as<Table>())
      variables = *table;
    else
      problems.add(entry->origin, "let",
                   fmt::format("wrong type, {} is given, allowed: one table, [let]",
                               document::type_name(entry->value)));
    std::erase_if(root, [](const Entry& other) { return other.key == "let"; });
  }
  problems.throw_if_any();
  Scope scope(variables, problems);
  problems.throw_if_any();
  scope.work_out();
  problems.throw_if_any();
  Replacement(scope.variables(), language, problems).in_table(root, "", "");
  scope.refuse_unused_overrides();
}

}  // namespace pulvis
