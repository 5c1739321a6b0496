// The tables of a scene as plain values: shared by the readers of two and three dimensions.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "scenes/keys/tables.hpp"
#include "scenes/language/table_reader.hpp"

namespace pulvis {

class SceneTables {
 public:
  SceneTables(const document::Table& root, Problems& problems, const schema::Language& language);

  const schema::Origins& origins() const { return tables_.origins(); }

 protected:
  static std::string numbered(const std::string& name, std::size_t i);

  template <class Spec>
  std::vector<Spec> read_all(const schema::TableDeclaration<Spec>& declaration) {
    return read_elements(declaration, root_, "");
  }

  template <class Spec>
  std::vector<Spec> read_elements(const schema::TableDeclaration<Spec>& declaration,
                                  const document::Table& parent, const std::string& parent_path) {
    const document::Array& elements = tables_.elements(parent, parent_path, declaration.info);
    const std::string name = declaration.info.path.substr(declaration.info.path.rfind('.') + 1);
    std::vector<Spec> specs(elements.size());
    for (std::size_t i = 0; i < elements.size(); ++i) {
      const std::string path = numbered(schema::joined_path(parent_path, name), i);
      specs[i].mark = elements[i].origin.mark;
      tables_.read(declaration, elements[i], path,
                   declaration.info.selector == "family" ? family_ : "", specs[i]);
    }
    return specs;
  }

  template <class Spec>
  void read_one(const schema::TableDeclaration<Spec>& declaration, Spec& spec) {
    if (const document::Entry* entry = document::find(root_, declaration.info.path))
      tables_.read(declaration, entry->value, declaration.info.path, "", spec);
  }

  // Including their flow laws.
  std::vector<MaterialSpec> read_materials();
  // The [stage.until] of a stage at `path`.
  void read_until(const schema::TableDeclaration<UntilSpec>& declaration,
                  const document::Table& table, const std::string& path, StageSpec& stage);
  // A table that read_all has found to be an array of tables, or to be missing.
  const document::Array& array_at(const std::string& name) const;

  const document::Table& root_;
  std::string family_;
  schema::TableReader tables_;

 private:
  std::shared_ptr<const FlowLaw> read_flow_law(const document::Table& material,
                                               const std::string& path);
};

}  // namespace pulvis
