// A language described for people and for editors, from the declarations the reader uses.
#pragma once

#include "scenes/language/schema.hpp"

#include <string>

namespace pulvis {

// One section a table: its keys with what is allowed, the default, and the meaning.
std::string reference_of(const std::string& introduction, const schema::Language& language);
}  // namespace pulvis
