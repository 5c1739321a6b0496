// Decodes one value of the tree as its key's declaration requires, or refuses it.
#pragma once

#include "scenes/language/schema.hpp"

#include <map>
#include <stdexcept>

namespace pulvis::schema {

// The names declared by each repeated table, by position; "" where an element has no usable name.
// A table that is not a list has no entry: it is refused itself, so references to it are not.
using Names = std::map<std::string, std::vector<std::string>>;
// Not a table: tools that touch nothing, so that no pair of surfaces may name them.
inline constexpr const char* without_contact = "tool without contact";

struct Refusal : std::runtime_error {
  Refusal(const document::Origin& where, const std::string& message)
      : std::runtime_error(message), origin(where) {}
  document::Origin origin;
};

Decoded decode(const KeyInfo& key, const document::Value& value, const Names& names);

}  // namespace pulvis::schema
