// The scene language described for readers and for editors.
#pragma once

#include <string>

namespace pulvis {

std::string scene_reference();    // docs/scene.md
std::string scene_json_schema();  // docs/scene.schema.json

}  // namespace pulvis
