// One value of the tree turned into what its key's declaration asks for, or refused.
#pragma once

#include "scenes/language/schema.hpp"

#include <map>
#include <stdexcept>

namespace pulvis::schema {

// The names each repeated table declares, by position; "" where an element has no usable name.
// A table that is no list has no entry: it is refused itself, and no reference to it besides.
using Names = std::map<std::string, std::vector<std::string>>;

struct Refusal : std::runtime_error {
  Refusal(const document::Origin& where, const std::string& message)
      : std::runtime_error(message), origin(where) {}
  document::Origin origin;
};

Decoded decode(const KeyInfo& key, const document::Value& value, const Names& names);

}  // namespace pulvis::schema
