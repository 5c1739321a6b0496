#include "scenes/keys/scene_tables.hpp"

#include <fmt/format.h>

#include "scenes/materials/library.hpp"
#include "systems/laws/flow_law.hpp"

namespace pulvis {

using document::Array;
using document::Entry;

SceneTables::SceneTables(const document::Table& root, Problems& problems,
                         const schema::Language& language)
    : root_(root), tables_(root, problems, language) {
  if (const std::string* family = document::find_text(root, "family")) family_ = *family;
  tables_.explain_references([](const std::string& table, const std::string& name) {
    const LibraryMaterial* material = table == "material" ? likely_material(name) : nullptr;
    return material == nullptr
               ? std::string()
               : fmt::format(
                     "; to take it from the library: [[material]] name = \"{}\", library "
                     "= \"{}\"",
                     name, material->name);
  });
}

std::string SceneTables::numbered(const std::string& name, std::size_t i) {
  return fmt::format("{}[{}]", name, i);
}

std::vector<MaterialSpec> SceneTables::read_materials() {
  std::vector<MaterialSpec> materials = read_all(schema::material());
  const Array& elements = array_at("material");
  for (std::size_t i = 0; i < materials.size(); ++i) {
    const document::Table& table = elements[i].get<document::Table>();
    const std::string path = numbered("material", i);
    materials[i].flow = read_flow_law(table, path);
    if (const Entry* damping = document::find(table, "damping"))
      tables_.read(schema::material_damping(), damping->value, path + ".damping", family_,
                   materials[i]);
  }
  return materials;
}

std::shared_ptr<const FlowLaw> SceneTables::read_flow_law(const document::Table& material,
                                                          const std::string& path) {
  const Entry* hardening = document::find(material, "hardening");
  const Entry* rate = document::find(material, "rate");
  if (hardening == nullptr && rate == nullptr) return nullptr;
  auto law = std::make_shared<FlowLaw>();
  if (hardening != nullptr)
    tables_.read(schema::hardening(), hardening->value, path + ".hardening", "", *law);
  if (rate != nullptr) tables_.read(schema::rate(), rate->value, path + ".rate", "", *law);
  return law;
}

void SceneTables::read_until(const schema::TableDeclaration<UntilSpec>& declaration,
                             const document::Table& table, const std::string& path,
                             StageSpec& stage) {
  const Entry* entry = document::find(table, "until");
  if (entry == nullptr) return;
  stage.until.emplace().mark = entry->origin.mark;
  tables_.read(declaration, entry->value, path + ".until", "", *stage.until);
}

const Array& SceneTables::array_at(const std::string& name) const {
  static const Array none;
  const Entry* entry = document::find(root_, name);
  const bool usable = entry != nullptr && document::is_array_of_tables(entry->value);
  return usable ? entry->value.get<Array>() : none;
}

}  // namespace pulvis
