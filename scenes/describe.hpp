// The scene language described for people and for editors, from the declarations the reader uses.
#pragma once

#include <string>

namespace pulvis {

std::string scene_reference();    // docs/scene.md
std::string scene_json_schema();  // docs/scene.schema.json, JSON Schema 2020-12

}  // namespace pulvis
