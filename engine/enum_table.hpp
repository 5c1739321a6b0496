// Tables indexed by an enumeration, whose length the compiler checks.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <type_traits>

namespace pulvis {

// Compilers print an enumerator by its name, and any other value as a cast of a number: "Shape::die", "(Shape)4".
// (Not within class templates: clang 14 prints numbers there.)
template <auto value>
consteval bool is_enumerator() {
  constexpr std::string_view function = __PRETTY_FUNCTION__;
  constexpr std::size_t begin = function.rfind("value = ") + std::string_view("value = ").size();
  constexpr std::string_view printed = function.substr(begin);
  constexpr std::size_t cast = printed.rfind(')');
  constexpr char first = printed[cast == std::string_view::npos ? 0 : cast + 1];
  return first != '-' && (first < '0' || first > '9');
}

// Number of values of an enumeration that counts from 0.
template <class Enum, std::size_t from = 0>
consteval std::size_t count_of() {
  if constexpr (is_enumerator<static_cast<Enum>(from)>())
    return count_of<Enum, from + 1>();
  else
    return from;
}

// One entry for each value of a scoped enumeration, in its order; too few or too many do not compile.
template <class Enum, class Entry = const char*>
class EnumTable {
 public:
  template <class... Entries>
  requires(sizeof...(Entries) == count_of<Enum>()) consteval EnumTable(Entries... entries)
      : entries_{entries...} {}
  constexpr const Entry& operator[](Enum value) const {
    return entries_[static_cast<std::size_t>(value)];
  }

 private:
  std::array<Entry, count_of<Enum>()> entries_;
};

}  // namespace pulvis
