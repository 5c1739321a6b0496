#include "key_values.hpp"

#include <fmt/format.h>

#include <cmath>

#include "scenes/language/units.hpp"

namespace pulvis::keys {
namespace {

using document::Table;
using document::Value;
using schema::KeyInfo;
using schema::Kind;

std::optional<double> number_in(const Value& value, const std::string& unit) {
  if (const auto* number = value.as<double>()) return *number;
  if (const auto* integer = value.as<std::int64_t>()) return static_cast<double>(*integer);
  const auto* text = value.as<std::string>();
  if (text == nullptr || unit.empty()) return std::nullopt;
  try {
    return parse_quantity(*text, unit);
  } catch (const UnitError&) {
    return std::nullopt;
  }
}

// Near the default, then near what stands beside it in the same unit, then anything.
std::vector<double> numbers_for(const KeyInfo& key, const schema::TableView& view,
                                const Table& around) {
  std::vector<double> numbers;
  const double fallback = key.fallback ? number_in(*key.fallback, key.unit).value_or(0) : 0;
  for (const double factor : {1.25, 0.8, 2.0})
    if (fallback != 0) numbers.push_back(factor * fallback);
  for (const document::Entry& entry : around) {
    const KeyInfo* other = schema::find_key(view, entry.key);
    if (key.unit.empty() || other == nullptr || other->unit != key.unit) continue;
    if (const auto beside = number_in(entry.value, key.unit); beside && *beside != 0)
      for (const double factor : {0.1, 0.5, 1.5}) numbers.push_back(factor * std::abs(*beside));
  }
  for (const double share : {0.3, 0.6, 0.9})
    if (std::isfinite(key.range.low) && key.range.high < 100)
      numbers.push_back(key.range.low + share * (key.range.high - key.range.low));
  for (const int exponent : {-3, -2, -1, 0, -4, -5, -6, -7, -8, -9, 1, 2, 3, 4, 6, 9, 12})
    numbers.push_back(std::pow(10.0, exponent));
  std::erase_if(numbers,
                [&](double number) { return !key.range.holds(number) || number == fallback; });
  return numbers;
}

std::vector<Value> quantities_for(const KeyInfo& key, const schema::TableView& view,
                                  const Table& around) {
  std::vector<Value> values;
  for (const double number : numbers_for(key, view, around))
    values.push_back({fmt::format("{:.6g} {}", number, key.unit), {}});
  return values;
}

std::vector<std::int64_t> integers_for(const KeyInfo& key) {
  const std::int64_t step = key.multiple_of;
  const auto* fallback = key.fallback ? key.fallback->as<std::int64_t>() : nullptr;
  std::vector<std::int64_t> integers;
  for (const std::int64_t away : {step, -step, 2 * step})
    if (fallback != nullptr) integers.push_back(*fallback + away);
  for (const std::int64_t number : {2, 3, 4, 8, 12, 16, 24, 48, 1, 0, 100, 1000})
    if (number % step == 0) integers.push_back(number);
  std::erase_if(integers, [&](std::int64_t number) {
    return !key.range.holds(static_cast<double>(number)) ||
           (fallback != nullptr && number == *fallback);
  });
  return integers;
}

std::vector<Value> words_for(const KeyInfo& key) {
  std::vector<Value> words;
  const auto* fallback = key.fallback ? key.fallback->as<std::string>() : nullptr;
  for (const schema::Choice& choice : key.choices)
    if (fallback == nullptr || choice.word != *fallback) words.push_back({choice.word, {}});
  return words;
}

// As many as the key has components: the last one is another.
Value list_of(const KeyInfo& key, const Value& first, const Value& last) {
  document::Array array(static_cast<std::size_t>(key.components), first);
  array.back() = last;
  return {std::move(array), {}};
}

std::vector<Value> directions_for(const KeyInfo& key) {
  std::vector<Value> directions;
  for (const auto& [first, last] : {std::pair{0.6, 0.8}, {0.0, 1.0}, {1.0, 0.0}})
    directions.push_back(list_of(key, {first, {}}, {last, {}}));
  return directions;
}

std::vector<Value> names_of(const std::string& table, const Table& root) {
  std::vector<Value> names;
  const document::Entry* entry = document::find(root, table);
  if (entry == nullptr || !document::is_array_of_tables(entry->value)) return names;
  for (const Value& element : entry->value.get<document::Array>())
    if (const auto* name = document::find_text(element.get<Table>(), "name"))
      names.push_back({*name, {}});
  return names;
}

}  // namespace

std::vector<Value> values_for(const KeyInfo& key, const schema::TableView& view,
                              const Table& around, const Table& root) {
  const auto quantities = [&] { return quantities_for(key, view, around); };
  std::vector<Value> values;
  switch (key.kind) {
    case Kind::quantity:
    case Kind::phase:
      values = quantities();
      if (!key.word.empty()) values.push_back({key.word, {}});
      break;
    case Kind::vector:
      for (const Value& x : quantities()) values.push_back(list_of(key, x, x));
      for (const Value& word : words_for(key))
        for (const Value& x : quantities()) values.push_back(list_of(key, x, word));
      break;
    case Kind::number:
      for (const double number : numbers_for(key, view, around)) values.push_back({number, {}});
      for (const Value& word : words_for(key)) values.push_back(word);
      break;
    case Kind::integer:
      for (const std::int64_t number : integers_for(key)) values.push_back({number, {}});
      break;
    case Kind::counts:
      for (const std::int64_t number : integers_for(key))
        values.push_back(list_of(key, {number, {}}, {number, {}}));
      break;
    case Kind::integers:
      for (const std::int64_t number : integers_for(key))
        values.push_back({document::Array{{number, {}}, {number + 1, {}}}, {}});
      break;
    case Kind::numbers:
      for (const double number : numbers_for(key, view, around))
        values.push_back({document::Array{{number, {}}, {2 * number, {}}}, {}});
      break;
    case Kind::flag:
      values.push_back({!key.fallback || !key.fallback->get<bool>(), {}});
      break;
    case Kind::direction:
      values = directions_for(key);
      break;
    case Kind::text:
      values.push_back({std::string("générée \"ici\""), {}});
      break;
    case Kind::choice:
      values = words_for(key);
      break;
    case Kind::reference:
      values = names_of(key.refers_to, root);
      break;
    case Kind::points:
    case Kind::name:
    case Kind::name_pair:
    case Kind::bound:
    case Kind::texts:
    case Kind::file:
    case Kind::scene:
      break;
  }
  return values;
}

}  // namespace pulvis::keys
