// Describes the language of scenes in three dimensions for people and editors.
#pragma once

#include <string>

namespace pulvis {

std::string space_scene_reference();    // docs/scene-3d.md
std::string space_scene_json_schema();  // docs/scene-3d.schema.json

}  // namespace pulvis
