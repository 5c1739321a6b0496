// Describes a language for people and editors, from the declarations that the reader uses.
#pragma once

#include "scenes/language/schema.hpp"

#include <string>

namespace pulvis {

// One section per table: its keys with allowed values, default and meaning.
std::string reference_of(const std::string& introduction, const schema::Language& language);
}  // namespace pulvis
