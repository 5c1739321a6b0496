// The only file that sees toml++: its header is large, and its tree is converted to ours at once.
#include "scenes/language/document.hpp"
#include "engine/shortened.hpp"
#include "scenes/language/document_guard.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cmath>

namespace pulvis::document {
namespace {

Origin origin_of(const toml::source_region& source) {
  return {{static_cast<int>(source.begin.line), static_cast<int>(source.begin.column)}, -1};
}

Value copy(const toml::node& node);

Table copy_table(const toml::table& source) {
  Table table;
  for (const auto& [key, node] : source)
    table.push_back({std::string(key.str()), origin_of(key.source()), copy(node)});
  // toml++ sorts by name; in messages, people expect the order of the file.
  std::stable_sort(table.begin(), table.end(), [](const Entry& a, const Entry& b) {
    const SourceMark left = a.origin.mark, right = b.origin.mark;
    return std::pair(left.line, left.column) < std::pair(right.line, right.column);
  });
  return table;
}

Array copy_array(const toml::array& source) {
  Array array;
  array.reserve(source.size());
  for (const toml::node& node : source) array.push_back(copy(node));
  return array;
}

Value copy(const toml::node& node) {
  Value value;
  value.origin = origin_of(node.source());
  if (const auto* table = node.as_table()) value.data = copy_table(*table);
  if (const auto* array = node.as_array()) value.data = copy_array(*array);
  if (const auto* text = node.as_string()) value.data = text->get();
  if (const auto* integer = node.as_integer()) value.data = integer->get();
  if (const auto* number = node.as_floating_point()) value.data = number->get();
  if (const auto* flag = node.as_boolean()) value.data = flag->get();
  return value;
}

template <class T>
std::string joined(const std::vector<T>& parts, std::string (*write)(const T&)) {
  std::string text;
  for (const T& part : parts) text += (text.empty() ? "" : ", ") + write(part);
  return text;
}

std::string entry_text(const Entry& entry) { return entry.key + " = " + value_text(entry.value); }

std::string number_text(double number) {
  if (!std::isfinite(number)) return std::isnan(number) ? "nan" : (number > 0 ? "inf" : "-inf");
  std::string text = fmt::format("{}", number);
  return text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
}

std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\')
      result += {'\\', c};
    else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
      result += fmt::format("\\u{:04X}", static_cast<unsigned>(c));
    else
      result += c;
  }
  return result + '"';
}

struct WriteValue {
  std::string operator()(Unsupported) const { return "a date or time"; }
  std::string operator()(bool flag) const { return flag ? "true" : "false"; }
  std::string operator()(std::int64_t integer) const { return fmt::format("{}", integer); }
  std::string operator()(double number) const { return number_text(number); }
  std::string operator()(const std::string& text) const { return quoted(text); }
  std::string operator()(const Array& array) const {
    return fmt::format("[{}]", joined(array, value_text));
  }
  std::string operator()(const Table& table) const {
    return fmt::format("{{{}}}", joined(table, entry_text));
  }
};

std::string_view line_of(std::string_view text, int number) {
  for (int line = 1; line < number; ++line)
    text.remove_prefix(std::min(text.size(), text.find('\n') + 1));
  return text.substr(0, text.find('\n'));
}

// "friction = 0,5": a number, a comma and a digit directly after the equals sign.
bool has_decimal_comma(std::string_view line) {
  const auto is_digit = [&](std::size_t i) {
    return i < line.size() && line[i] >= '0' && line[i] <= '9';
  };
  const std::size_t comma = line.find(','), equals = line.find('=');
  if (comma == std::string_view::npos || equals >= comma || !is_digit(comma - 1)) return false;
  const std::string_view number = line.substr(equals + 1, comma - equals - 1);
  return is_digit(comma + 1) &&
         number.find_first_not_of(" \t+-0123456789") == std::string_view::npos;
}

std::string_view without_blanks(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return "";
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

// "compaction", "1 mm": a word or a quantity that lacks its quotes; otherwise empty. Lists and tables are left alone.
std::string_view bare_text(std::string_view line) {
  const std::size_t equals = line.find('=');
  if (equals == std::string_view::npos) return "";
  std::string_view value = line.substr(equals + 1);
  value = without_blanks(value.substr(0, value.find('#')));
  if (value.find_first_of("\"'[]{}=,") != std::string_view::npos) return "";
  const bool has_letter = std::ranges::any_of(value, is_letter);
  return has_letter && value != "true" && value != "false" ? value : "";
}

// "friction: 0.1", "friction 0.1": a key and a value without '='.
bool lacks_equals(std::string_view line) {
  const std::size_t end = line.find_first_of(" \t:");
  return line.find('=') == std::string_view::npos && end != std::string_view::npos && end > 0 &&
         is_letter(line.front()) && !without_blanks(line.substr(end + 1)).empty();
}

// The library says what is wrong, but not what would be right.
std::string explained(const std::string& description, std::string_view line) {
  const bool twice = description.find("cannot redefine") != std::string::npos;
  if (twice) return description + ", allowed: each key once";
  if (has_decimal_comma(line))
    return "a decimal comma in a number, allowed: a decimal point, such as 0.5";
  if (const std::string_view text = bare_text(line); !text.empty())
    return fmt::format("text without quotes, allowed: \"{}\" for a word or a quantity",
                       shortened(text));
  if (lacks_equals(without_blanks(line)))
    return "a key and its value are joined by '=', allowed: key = value";
  return description + ", allowed: TOML 1.0";
}

}  // namespace

Table parse(std::string_view text) {
  guard(text);
  try {
    return copy_table(toml::parse(text));
  } catch (const toml::parse_error& error) {
    const SourceMark mark = origin_of(error.source()).mark;
    throw SyntaxError(mark, explained(std::string(error.description()), line_of(text, mark.line)));
  }
}

std::optional<Value> parse_value(const std::string& text) {
  try {
    Table table = parse("value = " + text);
    const bool one_value = table.size() == 1 && table.front().key == "value";
    if (!one_value || table.front().value.as<Unsupported>() != nullptr) return std::nullopt;
    return std::move(table.front().value);
  } catch (const SyntaxError&) {
    return std::nullopt;
  }
}

const Entry* find(const Table& table, std::string_view key) {
  const auto found = std::find_if(table.begin(), table.end(),
                                  [key](const Entry& entry) { return entry.key == key; });
  return found == table.end() ? nullptr : &*found;
}

Entry* find(Table& table, std::string_view key) {
  const auto found = std::find_if(table.begin(), table.end(),
                                  [key](const Entry& entry) { return entry.key == key; });
  return found == table.end() ? nullptr : &*found;
}

const std::string* find_text(const Table& table, std::string_view key) {
  const Entry* entry = find(table, key);
  return entry == nullptr ? nullptr : entry->value.as<std::string>();
}

bool is_array_of_tables(const Value& value) {
  const Array* array = value.as<Array>();
  return array != nullptr && !array->empty() &&
         std::all_of(array->begin(), array->end(),
                     [](const Value& element) { return element.as<Table>() != nullptr; });
}

std::string type_name(const Value& value) {
  static const char* const names[] = {"a date or time", "a boolean", "an integer", "a number",
                                      "a string",       "an array",  "a table"};
  return is_array_of_tables(value) ? "an array of tables" : names[value.data.index()];
}

std::string value_text(const Value& value) { return std::visit(WriteValue{}, value.data); }

}  // namespace pulvis::document
