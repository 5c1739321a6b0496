#include "scenes/language/override.hpp"
#include "scenes/language/document_guard.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <span>

#include "engine/shortened.hpp"

namespace pulvis {
namespace {

using document::Value;

struct Refused : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct Step {
  std::string key;
  std::optional<std::size_t> position;  // "[3]"
};

constexpr const char* form = "allowed: key.path=value, e.g. time.safety=0.5";

// Position of the first `separator` outside quotes.
std::size_t find_unquoted(std::string_view text, char separator) {
  char quote = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quote == 0 && c == separator) return i;
    if (quote != 0 && c == quote)
      quote = 0;
    else if (quote == 0 && (c == '"' || c == '\''))
      quote = c;
  }
  return std::string_view::npos;
}

std::string trimmed(std::string text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

std::string unquoted(const std::string& word) {
  const bool quoted = word.size() >= 2 && (word.front() == '"' || word.front() == '\'') &&
                      word.front() == word.back();
  return quoted ? word.substr(1, word.size() - 2) : word;
}

std::size_t position_in(const std::string& brackets) {
  std::size_t position = 0;
  const char* const end = brackets.data() + brackets.size() - 1;
  const auto read = std::from_chars(brackets.data() + 1, end, position);
  if (brackets.back() != ']' || read.ec != std::errc() || read.ptr != end)
    throw Refused(
        fmt::format("'{}' is not a position, allowed: [0], [1], ...", shortened(brackets)));
  return position;
}

// "material[0]" is two steps: into `material`, and to its first element.
void add_steps(std::vector<Step>& steps, const std::string& part) {
  const std::size_t bracket = find_unquoted(part, '[');
  const std::string key = unquoted(trimmed(part.substr(0, bracket)));
  if (key.empty()) throw Refused(fmt::format("an empty name in the path, {}", form));
  steps.push_back({key, std::nullopt});
  if (bracket != std::string::npos)
    steps.push_back({"", position_in(trimmed(part.substr(bracket)))});
}

std::vector<Step> steps_of(std::string path) {
  constexpr std::size_t deepest = 8;  // stage[0].move[0].ramp has five
  std::vector<Step> steps;
  for (std::size_t dot = 0; dot != std::string::npos;) {
    dot = find_unquoted(path, '.');
    add_steps(steps, path.substr(0, dot));
    if (dot != std::string::npos) path.erase(0, dot + 1);
    if (steps.size() > deepest) throw Refused(fmt::format("the path is too deep, {}", form));
  }
  return steps;
}

// "packing[0] to packing[2]"
std::string positions_in(const document::Array& array, const std::string& list) {
  const std::string first = fmt::format("{}[0]", shortened(list));
  return array.size() < 2 ? first
                          : fmt::format("{} to {}[{}]", first, shortened(list), array.size() - 1);
}

Value& element_at(document::Array& array, std::size_t position, const std::string& list) {
  if (position < array.size()) return array[position];
  throw Refused(
      fmt::format("there is no element [{}], allowed: {}", position, positions_in(array, list)));
}

// By name; a move has none and is selected by its tool.
Value& element_called(document::Array& array, const std::string& name, const std::string& list) {
  std::vector<std::string> names;
  for (Value& element : array) {
    const document::Table& table = element.get<document::Table>();
    const std::string* own = document::find_text(table, "name");
    if (own == nullptr) own = document::find_text(table, "tool");
    if (own != nullptr && *own == name) return element;
    if (own != nullptr) names.push_back(*own);
  }
  const bool is_number = !name.empty() && name.find_first_not_of("0123456789") == std::string::npos;
  const std::string hint =
      is_number ? ": a position is written in brackets" : suggestion(name, names);
  throw Refused(
      fmt::format("no element is called '{}'{}, allowed: {}{}", shortened(name), hint,
                  positions_in(array, list),
                  names.empty() ? "; these elements have no names" : ", or " + listed(names)));
}

// `list`: the key that led here.
Value& entered(Value& here, const Step& step, const std::string& list,
               const document::Origin& origin) {
  if (document::is_array_of_tables(here)) {
    auto& array = here.get<document::Array>();
    return step.position ? element_at(array, *step.position, list)
                         : element_called(array, step.key, list);
  }
  auto* table = here.as<document::Table>();
  if (table == nullptr || step.position)
    throw Refused(fmt::format("the path leads into {}", document::type_name(here)));
  if (document::Entry* entry = document::find(*table, step.key)) return entry->value;
  table->push_back({step.key, origin, {document::Table{}, origin}});
  return table->back().value;
}

void stamp(Value& value, const document::Origin& origin) {
  value.origin = origin;
  if (auto* array = value.as<document::Array>())
    for (Value& element : *array) stamp(element, origin);
}

bool holds_tables(const Value& value) {
  const auto* array = value.as<document::Array>();
  return value.as<document::Table>() != nullptr ||
         (array != nullptr && std::any_of(array->begin(), array->end(), holds_tables));
}

Value parsed(const std::string& text, const document::Origin& origin) {
  try {
    document::guard("#" + text);  // a string without quotes must obey the rules of a file, too
  } catch (const document::SyntaxError& error) {
    throw Refused(error.what());
  }
  Value value = document::parse_value(text).value_or(Value{text, {}});
  if (holds_tables(value)) throw Refused("a table is given, allowed: one key at a time");
  stamp(value, origin);
  return value;
}

// Returns the origin of the value that was there.
document::Origin assign(Value& here, const Step& last, Value value, const std::string& list,
                        const document::Origin& origin) {
  auto* table = here.as<document::Table>();
  if (document::is_array_of_tables(here) && !last.position)
    throw Refused(fmt::format("'{}' is a list, allowed: a key of one of its elements, {}",
                              shortened(list), positions_in(here.get<document::Array>(), list)));
  if (table == nullptr || last.position)
    throw Refused(
        fmt::format("the path ends at {}, allowed: a key of one element, such as "
                    "material[0].density",
                    document::type_name(here)));
  document::Entry* entry = document::find(*table, last.key);
  if (entry == nullptr) {
    table->push_back({last.key, origin, std::move(value)});
    return {{}, -1};
  }
  if (holds_tables(entry->value))
    throw Refused("the path ends at a table, allowed: one of its keys");
  const document::Origin before = entry->origin;
  *entry = {last.key, origin, std::move(value)};
  return before;
}

document::Origin apply(Value& root, const std::string& path, const std::string& text, int index) {
  const document::Origin origin{{}, index};
  const std::vector<Step> steps = steps_of(path);
  Value value = parsed(trimmed(text), origin);
  Value* here = &root;
  std::string list;
  for (std::size_t i = 0; i + 1 < steps.size(); ++i) {
    here = &entered(*here, steps[i], list, origin);
    if (!steps[i].position) list = steps[i].key;
  }
  return assign(*here, steps.back(), std::move(value), list, origin);
}

std::vector<std::string> keys_of(const document::Table& table) {
  std::vector<std::string> keys;
  for (const document::Entry& entry : table) keys.push_back(entry.key);
  return keys;
}

document::Table::iterator entry_called(document::Table& table, const std::string& key) {
  const auto entry = std::ranges::find(table, key, &document::Entry::key);
  if (entry != table.end()) return entry;
  throw Refused(fmt::format("there is no '{}'{}, allowed: {}", shortened(key),
                            suggestion(key, keys_of(table)), listed(keys_of(table))));
}

void take_out(Value& here, std::span<const Step> steps, const std::string& list = "") {
  const bool last = steps.size() == 1;
  if (document::is_array_of_tables(here)) {
    auto& array = here.get<document::Array>();
    Value& element = entered(here, steps.front(), list, {});
    if (last)
      array.erase(array.begin() + (&element - array.data()));
    else
      take_out(element, steps.subspan(1));
    return;
  }
  auto* table = here.as<document::Table>();
  if (table == nullptr || steps.front().position)
    throw Refused(fmt::format("the path leads into {}", document::type_name(here)));
  const auto entry = entry_called(*table, steps.front().key);
  if (!last) take_out(entry->value, steps.subspan(1), entry->key);
  const auto* array = entry->value.as<document::Array>();
  if (last || (array != nullptr && array->empty())) table->erase(entry);
}

}  // namespace

void remove_path(document::Table& root, const std::string& path, const document::Origin& where,
                 Problems& problems) {
  Value top{std::move(root), {}};
  try {
    take_out(top, steps_of(path));
  } catch (const Refused& refused) {
    problems.add(where, "remove", fmt::format("\"{}\": {}", shortened(path), refused.what()));
  }
  root = std::move(top.get<document::Table>());
}

std::string key_of(const std::string& override_text) {
  return trimmed(override_text.substr(0, find_unquoted(override_text, '=')));
}

std::vector<ReplacedOverride> apply_overrides(document::Table& root,
                                              const std::vector<std::string>& overrides,
                                              Problems& problems) {
  Value top{std::move(root), {}};
  std::vector<ReplacedOverride> replaced;
  for (std::size_t i = 0; i < overrides.size(); ++i) {
    const int index = static_cast<int>(i);
    const std::size_t equals = find_unquoted(overrides[i], '=');
    const std::string path = key_of(overrides[i]);
    try {
      if (equals == std::string::npos) throw Refused(fmt::format("there is no '=', {}", form));
      const document::Origin before = apply(top, path, overrides[i].substr(equals + 1), index);
      if (before.override_index >= 0)
        replaced.push_back({static_cast<std::size_t>(before.override_index), i});
    } catch (const Refused& refused) {
      problems.add({{}, index}, path, refused.what());
    }
  }
  root = std::move(top.get<document::Table>());
  return replaced;
}

}  // namespace pulvis
