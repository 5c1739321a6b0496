// The scene language described for people and for editors, from the declarations the reader uses.
#pragma once

#include <string>

#include "scenes/schema.hpp"

namespace pulvis {

// One section a table: its keys with what is allowed, the default, and the meaning.
std::string describe_tables(const schema::Language& language);

std::string scene_reference();    // docs/scene.md
std::string scene_json_schema();  // docs/scene.schema.json, JSON Schema 2020-12

}  // namespace pulvis
