// Materials that scenes refer to by name, each with the source of its values: scenes/materials/library.toml.
#pragma once

#include <string>
#include <vector>

#include "scenes/language/problem.hpp"
#include "scenes/language/schema.hpp"

namespace pulvis {

struct LibraryMaterial {
  std::string name, title, source;
  document::Table values;  // in the form of [[material]]
};

const std::vector<LibraryMaterial>& material_library();
// What somebody who writes "copper", "316l" or "aluminum" may mean; null if nothing is close.
const LibraryMaterial* likely_material(const std::string& word);

// Copies the values of `library` into every [[material]] that has one, except those it sets itself; the keys
// `library` and `elastic` are removed.
void fill_materials(document::Table& root, const schema::Language& language, Problems& problems);

std::string material_reference();  // docs/materials.md

}  // namespace pulvis
