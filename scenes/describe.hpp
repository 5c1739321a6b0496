// The scene language described for people and for editors, from the declarations the reader uses.
#pragma once

#include "scenes/schema.hpp"

#include <string>

namespace pulvis {

std::string scene_reference();    // docs/scene.md
std::string scene_json_schema();  // docs/scene.schema.json, JSON Schema 2020-12

// The same for another kind of file, declared in the same way: one section a table, its keys with what is
// allowed, the default, and the meaning.
std::string reference_of(const std::string& introduction, const schema::Language& language);
std::string json_schema_of(const std::string& title, const std::string& declared_in,
                           const schema::Language& language);

}  // namespace pulvis
