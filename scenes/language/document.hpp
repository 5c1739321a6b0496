// A scene file as a tree of plain values, each with its source location. It stands between
// the TOML library, which only document.cpp sees, and the reader: overrides and default values are
// inserted into this tree before anything is read from it.
#pragma once

#include "scenes/language/source_mark.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace pulvis::document {

inline constexpr std::size_t largest_file = 16U << 20U;  // bytes; scenes are written by hand

struct Origin {
  SourceMark mark;
  int override_index = -1;  // >= 0: set by this override, not by a file
};

struct Value;
struct Entry;
using Array = std::vector<Value>;
using Table = std::vector<Entry>;  // in file order

struct Unsupported {};  // a date or a time: TOML has them, scenes do not

struct Value {
  std::variant<Unsupported, bool, std::int64_t, double, std::string, Array, Table> data;
  Origin origin;

  template <class T>
  const T* as() const {
    return std::get_if<T>(&data);
  }
  template <class T>
  T* as() {
    return std::get_if<T>(&data);
  }
  template <class T>
  const T& get() const {  // if the type is already known
    return std::get<T>(data);
  }
  template <class T>
  T& get() {
    return std::get<T>(data);
  }
};

struct Entry {
  std::string key;
  Origin origin;  // of the key
  Value value;
};

struct SyntaxError : std::runtime_error {
  SyntaxError(SourceMark where, const std::string& message)
      : std::runtime_error(message), mark(where) {}
  SourceMark mark;
};

Table parse(std::string_view text);                         // throws SyntaxError
std::optional<Value> parse_value(const std::string& text);  // empty: not a single TOML value

Entry* find(Table& table, std::string_view key);
const Entry* find(const Table& table, std::string_view key);
const std::string* find_text(const Table& table,
                             std::string_view key);  // null: absent, or not a string
bool is_array_of_tables(const Value& value);
std::string type_name(const Value& value);   // "a string", "an integer", ...
std::string value_text(const Value& value);  // as TOML writes it, on one line

}  // namespace pulvis::document
