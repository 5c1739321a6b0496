// Keys of a language, as its declarations have them, and which of them a file makes use of.
#pragma once

#include <compare>
#include <set>
#include <string>
#include <vector>

#include "scenes/language/schema.hpp"

namespace pulvis::keys {

// A key with a value that is not its default; or one word of those it may be.
struct Use {
  std::string table, key, word;
  auto operator<=>(const Use&) const = default;
  std::string text() const;  // tool.relief = "sine"
};
using Uses = std::set<Use>;

// What must be used somewhere: every key, and every word of a choice but its default.
Uses all_uses(const schema::Language& language);

Uses uses_in(const document::Table& root, const schema::Language& language);

// The places of a table in a file, as in --set: stage[1].move[0]. One that is not repeated and may be left
// out has its place, too.
std::vector<std::string> places_of(const std::string& table, const document::Table& root,
                                   const schema::Language& language);

const document::Table* table_at(const document::Table& root, const std::string& place);

// As TOML in the order of the tree, keys of a study's free tables included.
std::string toml_of(const document::Table& root);

}  // namespace pulvis::keys
