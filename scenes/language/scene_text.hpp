// Writes a scene's tree back as TOML, in one fixed layout: the run's folder keeps it as
// scene.toml, and the scene's hash is computed from it.
#pragma once

#include "scenes/language/schema.hpp"

namespace pulvis {

// Tables and keys are in the order of their declarations, whatever the order in the file. Only
// bodies and packings keep their file order relative to each other: it numbers the particles.
std::string scene_text(const document::Table& root, const schema::Language& language);

}  // namespace pulvis
