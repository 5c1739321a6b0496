// Where a key belongs that its table does not know: symbols and everyday words for declared keys, and keys of other
// tables. In TOML every key below a header belongs to that table, whatever its writer meant.
#pragma once

#include <string>
#include <vector>

#include "scenes/language/schema.hpp"

namespace pulvis::schema {

// ", did you mean 'youngs_modulus'?" or ": 'seed' belongs to the top level, ..."; empty if nothing is known.
std::string hint_of_unknown(const document::Entry& entry, const TableView& view,
                            const Language& language);

// "; a number called 'friction' belongs into [contact]" where a value stands for a table; otherwise empty.
std::string hint_of_value(const document::Entry& entry, const TableView& table,
                          const Language& language);

// For a word that is none of a choice: ", did you mean 'disc'?"; empty if nothing is close.
std::string hint_of_word(const std::string& word, const std::vector<std::string>& words);

}  // namespace pulvis::schema
