// Short forms for the declarations in declare_*.cpp.
#pragma once

#include <stdexcept>

#include "engine/enum_table.hpp"
#include "scenes/keys/tables.hpp"

namespace pulvis::schema {

inline constexpr double smallest_size =
    1e-12;                                   // m; below an atom continuum mechanics has no meaning
inline constexpr double largest_size = 1e3;  // m

inline document::Value value_of(const char* text) { return {std::string(text), {}}; }
inline document::Value value_of(double number) { return {number, {}}; }
inline document::Value value_of(int integer) { return {std::int64_t{integer}, {}}; }
inline document::Value value_of(bool flag) { return {flag, {}}; }
// Of a vector: as many components as the scene has dimensions.
inline document::Value zero_vector(const char* component) {
  return {document::Array{value_of(component)}, {}};
}

// Ranges [low, high], (low, high], (low, high).
inline Range within(double low, double high) { return {low, high, false, false}; }
inline Range above(double low, double high) { return {low, high, true, false}; }
inline Range between(double low, double high) { return {low, high, true, true}; }

// Setters for the common case of one member.
template <class Spec>
auto to(double Spec::*member) {
  return [member](Spec& spec, const Decoded& value) { spec.*member = value.number; };
}
template <class Spec>
auto to(std::optional<double> Spec::*member) {
  return [member](Spec& spec, const Decoded& value) { spec.*member = value.number; };
}
template <class Spec>
auto to(std::string Spec::*member) {
  return [member](Spec& spec, const Decoded& value) { spec.*member = value.text; };
}
template <class Spec>
auto to(Vec2 Spec::*member) {
  return [member](Spec& spec, const Decoded& value) { spec.*member = value.vector; };
}
template <class Spec>
auto to(Vec3 Spec::*member) {
  return [member](Spec& spec, const Decoded& value) { spec.*member = value.vector3; };
}
template <class Spec>
auto to(std::vector<Vec2> Spec::*member) {
  return [member](Spec& spec, const Decoded& value) { spec.*member = value.points; };
}
template <class Spec>
auto integer_to(int Spec::*member) {
  return [member](Spec& spec, const Decoded& value) {
    spec.*member = static_cast<int>(value.integer);
  };
}
template <class Spec>
auto integer_to(std::optional<int> Spec::*member) {
  return [member](Spec& spec, const Decoded& value) {
    spec.*member = static_cast<int>(value.integer);
  };
}
template <class Spec>
auto flag_to(bool Spec::*member) {
  return [member](Spec& spec, const Decoded& value) { spec.*member = value.flag; };
}
template <class Spec>
auto index_to(int Spec::*member) {
  return [member](Spec& spec, const Decoded& value) { spec.*member = value.index; };
}

// Kind::choice: its words, in the order of an enumeration.
template <class Enum, std::size_t count>
std::vector<Choice> words_of(const Choice (&words)[count]) {
  static_assert(count == count_of<Enum>(),
                "a key needs one word for each value of its enumeration");
  return {words, words + count};
}
// The value for the word that is given.
template <class Enum>
Enum value_for(const Decoded& value) {
  if (value.index < 0 || static_cast<std::size_t>(value.index) >= count_of<Enum>())
    throw std::logic_error("a key has more words than its enumeration has values");
  return static_cast<Enum>(value.index);
}
template <class Spec, class Enum>
requires std::is_enum_v<Enum>
auto word_to(Enum Spec::*member) {
  return [member](auto& spec, const Decoded& value) { spec.*member = value_for<Enum>(value); };
}
template <class Spec, class Enum>
auto word_to(std::optional<Enum> Spec::*member) {
  return [member](auto& spec, const Decoded& value) { spec.*member = value_for<Enum>(value); };
}

// For a key with one allowed value: it documents the scene and stores nothing.
template <class Spec>
void nothing(Spec&, const Decoded&) {}

}  // namespace pulvis::schema
