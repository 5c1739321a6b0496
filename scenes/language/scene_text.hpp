// Writes a scene's tree back as TOML, in one fixed layout: what the run's folder keeps as
// scene.toml and what the scene's hash is taken of.
#pragma once

#include "scenes/language/schema.hpp"

namespace pulvis {

// Tables and keys come in the order of their declarations, whatever the order of the file was. Only
// bodies and packings keep the file's order among themselves: it numbers the particles.
std::string scene_text(const document::Table& root, const schema::Language& language);

}  // namespace pulvis
