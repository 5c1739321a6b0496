// Materials that scenes take by name, each with the source of its values: scenes/materials/library.toml.
#pragma once

#include <string>
#include <vector>

#include "scenes/language/problem.hpp"
#include "scenes/language/schema.hpp"

namespace pulvis {

struct LibraryMaterial {
  std::string name, title, source;
  document::Table values;  // as [[material]] has them
};

const std::vector<LibraryMaterial>& material_library();

// The values of `library` put into every [[material]] that has one, but for those that it gives itself; the keys
// `library` and `elastic` are taken out.
void fill_materials(document::Table& root, const schema::Language& language, Problems& problems);

std::string material_reference();  // docs/materials.md

}  // namespace pulvis
