#include "scenes/language/decode.hpp"

#include "engine/shortened.hpp"
#include "scenes/language/key_hint.hpp"
#include "scenes/language/problem.hpp"
#include "scenes/language/unit_hint.hpp"
#include "scenes/language/units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace pulvis::schema {
namespace {

using document::Value;

[[noreturn]] void refuse(const KeyInfo& key, const Value& value, const std::string& what) {
  throw Refusal(value.origin, fmt::format("{}, allowed: {}", what, allowed(key)));
}

[[noreturn]] void refuse_type(const KeyInfo& key, const Value& value) {
  refuse(key, value, fmt::format("wrong type, {} is given", document::type_name(value)));
}

bool is_number(const Value& value) {
  return value.as<double>() != nullptr || value.as<std::int64_t>() != nullptr;
}

// A string that is a number and nothing else.
std::optional<double> only_number(const std::string& text) {
  double number = 0;
  const char* end = text.data() + text.size();
  const auto read = std::from_chars(text.data(), end, number);
  if (read.ec != std::errc() || read.ptr != end) return std::nullopt;
  return number;
}

// "0.5" and "0,5" as strings where a plain number is required.
void refuse_text(const KeyInfo& key, const Value& value, const std::string& text) {
  if (only_number(text))
    refuse(key, value,
           fmt::format("a number in quotes is given: write {} without them", shortened(text)));
  std::string with_point = text;
  if (std::ranges::count(text, ',') == 1) std::ranges::replace(with_point, ',', '.');
  if (with_point != text && only_number(with_point))
    refuse(key, value,
           fmt::format("\"{}\" has a decimal comma: write {}", shortened(text),
                       shortened(with_point)));
}

double bare_number(const KeyInfo& key, const Value& value) {
  if (const auto* text = value.as<std::string>()) refuse_text(key, value, *text);
  if (!is_number(value)) refuse_type(key, value);
  const auto* integer = value.as<std::int64_t>();
  const double number = integer != nullptr ? static_cast<double>(*integer) : value.get<double>();
  if (!std::isfinite(number))
    refuse(key, value, shortened(document::value_text(value)) + " is not finite");
  return number;
}

void check_range(const KeyInfo& key, const Value& value, double number) {
  if (key.range.holds(number)) return;
  const std::string unit = key.unit.empty() ? "" : " " + key.unit;
  const bool same = is_number(value);
  const std::string in_si = same ? "" : fmt::format(" = {}{}", number, unit);
  refuse(key, value,
         fmt::format("{}{} is out of range", shortened(document::value_text(value)), in_si));
}

double quantity(const KeyInfo& key, const Value& value) {
  const auto* text = value.as<std::string>();
  const std::optional<double> bare = is_number(value)  ? bare_number(key, value)
                                     : text != nullptr ? only_number(*text)
                                                       : std::nullopt;
  if (bare && std::isfinite(*bare))
    refuse(key, value,
           fmt::format("missing unit: {} has none, {} is expected: write one, such as {}",
                       shortened(document::value_text(value)), key.unit,
                       quantity_example(key, *bare)));
  if (text == nullptr) refuse_type(key, value);
  try {
    const double number = parse_quantity(*text, key.unit);
    check_range(key, value, number);
    return number;
  } catch (const UnitError& error) {
    refuse(key, value, error.what());
  }
}

const document::Array& parts_of(const KeyInfo& key, const Value& value, int number) {
  const auto* array = value.as<document::Array>();
  if (array == nullptr) refuse_type(key, value);
  if (static_cast<int>(array->size()) != number)
    refuse(key, value, fmt::format("an array of length {} is given", array->size()));
  return *array;
}
const document::Array& components_of(const KeyInfo& key, const Value& value) {
  return parts_of(key, value, key.components);
}

// In the declaration of the key.
int index_of(const Choice& choice, std::size_t at) {
  return choice.index < 0 ? static_cast<int>(at) : choice.index;
}

const std::string& word(const KeyInfo& key, const Value& value) {
  const auto* text = value.as<std::string>();
  if (text == nullptr) refuse_type(key, value);
  return *text;
}

bool is_name_character(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
         c == '-' || c == '+' || c == '.';
}

// Names become groups in the results file and keys in overrides.
std::string name(const KeyInfo& key, const Value& value) {
  const std::string& text = word(key, value);
  const bool only_dots = text.find_first_not_of('.') == std::string::npos;
  if (text.size() > 64 || only_dots || !std::all_of(text.begin(), text.end(), is_name_character))
    refuse(key, value, fmt::format("{} is not a name", shortened(document::value_text(value))));
  return text;
}

std::string line_of_text(const KeyInfo& key, const Value& value, std::size_t longest = 200) {
  const std::string& text = word(key, value);
  const bool control = std::any_of(text.begin(), text.end(), [](char c) {
    return static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
  });
  if (control || text.size() > longest)
    refuse(key, value, "the text is too long or not on one line");
  return text;
}

std::int64_t integer(const KeyInfo& key, const Value& value) {
  const auto* given = value.as<std::int64_t>();
  if (given == nullptr) refuse_type(key, value);
  check_range(key, value, static_cast<double>(*given));
  if (*given % key.multiple_of != 0)
    refuse(key, value, fmt::format("{} is not a multiple of {}", *given, key.multiple_of));
  return *given;
}

void set_counts(const KeyInfo& key, const Value& value, Decoded& result) {
  const document::Array& parts = components_of(key, value);
  for (std::size_t i = 0; i < parts.size(); ++i)
    result.counts3[i] = static_cast<int>(integer(key, parts[i]));
  result.counts = {result.counts3[0], result.counts3[1]};
}

bool flag(const KeyInfo& key, const Value& value) {
  const auto* given = value.as<bool>();
  if (given == nullptr) refuse_type(key, value);
  return *given;
}

int choice(const KeyInfo& key, const Value& value) {
  const std::string& given = word(key, value);
  std::vector<std::string> words;
  for (std::size_t i = 0; i < key.choices.size(); ++i) {
    if (key.choices[i].word == given) return index_of(key.choices[i], i);
    if (!given.empty() && key.choices[i].formerly == given)
      refuse(key, value, fmt::format("'{}' is called '{}' now", given, key.choices[i].word));
    words.push_back(key.choices[i].word);
  }
  refuse(key, value,
         fmt::format("{} is unknown{}", shortened(document::value_text(value)),
                     hint_of_word(given, words)));
}

int reference(const KeyInfo& key, const Value& value, const Names& names) {
  const std::string& given = word(key, value);
  const auto table = names.find(key.refers_to);
  if (table == names.end()) return 0;  // it is not a list
  const std::vector<std::string>& known = table->second;
  const auto found = std::find(known.begin(), known.end(), given);
  if (found != known.end() && !given.empty()) return static_cast<int>(found - known.begin());
  throw Refusal(value.origin, fmt::format("no {} is called {}{}, allowed: {}", key.refers_to,
                                          shortened(document::value_text(value)),
                                          suggestion(given, known), listed(known)));
}

// A vector in the plane, with z = 0.
Eigen::Vector3d vector(const KeyInfo& key, const Value& value) {
  const document::Array& parts = components_of(key, value);
  Eigen::Vector3d result = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < parts.size(); ++i)
    result[static_cast<Eigen::Index>(i)] = quantity(key, parts[i]);
  return result;
}

void set_vector(const Eigen::Vector3d& vector, Decoded& result) {
  result.vector3 = vector;
  result.vector = vector.head<2>();
}

// The index of a keyword that may replace a number; empty if it is not one.
std::optional<int> word_instead(const KeyInfo& key, const Value& value) {
  const auto* text = value.as<std::string>();
  for (std::size_t i = 0; text != nullptr && i < key.choices.size(); ++i)
    if (key.choices[i].word == *text) return index_of(key.choices[i], i);
  return std::nullopt;
}

void vector_or_word(const KeyInfo& key, const Value& value, Decoded& result) {
  const document::Array& parts = components_of(key, value);
  const std::optional<int> word = word_instead(key, parts.back());
  if (!word) return set_vector(vector(key, value), result);
  result.is_word = true;
  result.index = *word;
  Eigen::Vector3d known = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i + 1 < parts.size(); ++i)
    known[static_cast<Eigen::Index>(i)] = quantity(key, parts[i]);
  set_vector(known, result);
}

void number_or_word(const KeyInfo& key, const Value& value, Decoded& result) {
  if (const std::optional<int> word = word_instead(key, value)) {
    result.is_word = true;
    result.index = *word;
    return;
  }
  result.number = bare_number(key, value);
  check_range(key, value, result.number);
}

void set_points(const KeyInfo& key, const Value& value, Decoded& result) {
  const auto* array = value.as<document::Array>();
  if (array == nullptr) refuse_type(key, value);
  if (array->size() < 2)
    refuse(key, value, fmt::format("an array of length {} is given", array->size()));
  for (const Value& point : *array) {
    result.points3.push_back(vector(key, point));
    result.points.push_back(result.points3.back().head<2>());
  }
}

void set_direction(const KeyInfo& key, const Value& value, Decoded& result) {
  const document::Array& parts = components_of(key, value);
  Eigen::Vector3d given = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < parts.size(); ++i)
    given[static_cast<Eigen::Index>(i)] = bare_number(key, parts[i]);
  const double largest = given.cwiseAbs().maxCoeff();
  if (largest == 0) refuse(key, value, "a direction of length 0");
  // Scaled first: the square of 1e200 is infinite.
  result.vector = (given.head<2>() / largest).normalized();
  result.vector3 = (given / largest).normalized();
  if (key.components == 2) result.vector3.head<2>() = result.vector;
}

// Tools without contact are refused by the checks, with the reason.
std::string no_surface(const Value& part, std::vector<std::string> known, const Names& names) {
  if (const auto found = names.find(without_contact); found != names.end())
    std::erase_if(known, [&](const std::string& name) {
      return std::ranges::find(found->second, name) != found->second.end();
    });
  return fmt::format("no material or tool is called {}{}, allowed: {}",
                     shortened(document::value_text(part)),
                     suggestion(part.get<std::string>(), known), listed(known));
}

std::array<std::string, 2> name_pair(const KeyInfo& key, const Value& value, const Names& names) {
  const document::Array& parts = parts_of(key, value, 2);
  std::vector<std::string> known;
  for (const char* table : {"material", "tool"}) {
    const auto found = names.find(table);
    if (found == names.end()) return {word(key, parts[0]), word(key, parts[1])};
    known.insert(known.end(), found->second.begin(), found->second.end());
  }
  for (const Value& part : parts) {
    const std::string& given = word(key, part);
    if (given.empty() || std::find(known.begin(), known.end(), given) == known.end())
      throw Refusal(part.origin, no_surface(part, known, names));
  }
  return {word(key, parts[0]), word(key, parts[1])};
}

std::string text_of(const KeyInfo& key, const Value& value) {
  if (key.kind == Kind::name) return name(key, value);
  return line_of_text(key, value, key.kind == Kind::text ? 200 : 1000);
}

void phase_or_quantity(const KeyInfo& key, const Value& value, Decoded& result) {
  const auto* text = value.as<std::string>();
  result.is_word = text != nullptr && *text == key.word;
  if (!result.is_word) result.number = quantity(key, value);
}

// A quantity is converted if its unit is known.
void number_or_text(const KeyInfo& key, const Value& value, Decoded& result) {
  if (value.as<std::string>() != nullptr)
    result.text = line_of_text(key, value);
  else
    result.number = bare_number(key, value);
}

// The elements of a list; an empty list is refused.
const document::Array& list(const KeyInfo& key, const Value& value) {
  const auto* array = value.as<document::Array>();
  if (array == nullptr) refuse_type(key, value);
  if (array->empty()) refuse(key, value, "an empty array is given");
  return *array;
}

void add_to_list(const KeyInfo& key, const Value& value, Decoded& result) {
  if (key.kind == Kind::texts) result.texts.push_back(line_of_text(key, value, 10'000));
  if (key.kind == Kind::integers) result.integers.push_back(integer(key, value));
  if (key.kind == Kind::numbers) result.numbers.push_back(bare_number(key, value));
}

}  // namespace

Decoded decode(const KeyInfo& key, const Value& value, const Names& names) {
  Decoded result;
  switch (key.kind) {
    case Kind::quantity:
      result.number = quantity(key, value);
      break;
    case Kind::vector:
      vector_or_word(key, value, result);
      break;
    case Kind::points:
      set_points(key, value, result);
      break;
    case Kind::phase:
      phase_or_quantity(key, value, result);
      break;
    case Kind::number:
      number_or_word(key, value, result);
      break;
    case Kind::integer:
      result.integer = integer(key, value);
      break;
    case Kind::counts:
      set_counts(key, value, result);
      break;
    case Kind::flag:
      result.flag = flag(key, value);
      break;
    case Kind::direction:
      set_direction(key, value, result);
      break;
    case Kind::text:
    case Kind::file:
    case Kind::scene:
    case Kind::name:
      result.text = text_of(key, value);
      break;
    case Kind::choice:
      result.index = choice(key, value);
      break;
    case Kind::reference:
      result.index = reference(key, value, names);
      break;
    case Kind::name_pair:
      result.names = name_pair(key, value, names);
      break;
    case Kind::bound:
      number_or_text(key, value, result);
      break;
    case Kind::texts:
    case Kind::integers:
    case Kind::numbers:
      for (const Value& one : list(key, value)) add_to_list(key, one, result);
      break;
  }
  return result;
}

}  // namespace pulvis::schema
