// Description of a language for editors.
#pragma once

#include <string>
#include <vector>
#include "scenes/language/schema.hpp"

namespace pulvis {

// JSON Schema 2020-12; `required`: tables that a file must contain.
std::string json_schema_of(const std::string& title, const std::string& declared_in,
                           const schema::Language& language,
                           const std::vector<std::string>& required = {});

}  // namespace pulvis
