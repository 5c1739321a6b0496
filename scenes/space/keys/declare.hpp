// Short forms for the declarations in declare_*.cpp, in addition to those for two dimensions.
#pragma once

#include <algorithm>
#include <initializer_list>

#include "scenes/keys/declare.hpp"
#include "scenes/space/keys/tables.hpp"

namespace pulvis::space::language {

using schema::above;
using schema::between;
using schema::Decoded;
using schema::Key;
using schema::Kind;
using schema::largest_size;
using schema::nothing;
using schema::smallest_size;
using schema::TableDeclaration;
using schema::to;
using schema::value_for;
using schema::value_of;
using schema::within;
using schema::word_to;
using schema::Words;
using schema::words_of;

template <class Spec>
auto to(Vec3 Spec::*member) {
  return [member](Spec& spec, const Decoded& value) { spec.*member = value.vector3; };
}
template <class Spec>
auto to(std::optional<Vec3> Spec::*member) {
  return [member](Spec& spec, const Decoded& value) { spec.*member = value.vector3; };
}

inline document::Value triple_of(const char* x, const char* y, const char* z) {
  return {document::Array{value_of(x), value_of(y), value_of(z)}, {}};
}

// A table that also exists in two dimensions, without some of its keys.
template <class Spec>
TableDeclaration<Spec> without(TableDeclaration<Spec> table,
                               std::initializer_list<const char*> names) {
  std::erase_if(table.keys, [&](const Key<Spec>& key) {
    return std::ranges::any_of(names, [&](const char* name) { return key.info.name == name; });
  });
  return table;
}

template <class Spec>
Key<Spec>& key_of(TableDeclaration<Spec>& table, const char* name) {
  return *std::ranges::find_if(table.keys,
                               [&](const Key<Spec>& key) { return key.info.name == name; });
}

}  // namespace pulvis::space::language
