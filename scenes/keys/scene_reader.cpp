#include "scenes/keys/scene_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "scenes/materials/library.hpp"
#include "systems/laws/flow_law.hpp"

namespace pulvis {
namespace {

using document::Array;
using document::Entry;
using document::Table;
using document::Value;

std::string explained(const std::string& table, const std::string& name) {
  const LibraryMaterial* material = table == "material" ? likely_material(name) : nullptr;
  if (material == nullptr) return "";
  return fmt::format("; to take it from the library: [[material]] name = \"{}\", library = \"{}\"",
                     name, material->name);
}

class SceneReader {
 public:
  SceneReader(const Table& root, Problems& problems)
      : root_(root), language_(language_of(root)), tables_(root, problems, language_) {
    if (const std::string* family = document::find_text(root, "family")) family_ = *family;
    tables_.explain_references(explained);
  }

  Scene read(const std::filesystem::path& file) {
    Scene scene;
    scene.file = file;
    tables_.read(schema::top_level(), Value{root_, {{1, 1}, -1}}, "", "", scene);
    scene.materials = read_materials();
    if (scene.afm)
      read_afm(*scene.afm);
    else
      read_powder(scene);
    scene.expects = read_all(schema::expect());
    return scene;
  }

  const schema::Origins& origins() const { return tables_.origins(); }

 private:
  void read_powder(Scene& scene) {
    scene.dimension = dimension_of(root_);
    if (scene.in_space()) {
      scene.particles = read_particles(space::language::particle(), space::language::mesh());
    } else {
      scene.particles = read_particles(schema::particle(), schema::mesh());
      read_grains(scene.particles);
    }
    scene.packings = read_packings();
    scene.tools = read_all(schema::tool());
    scene.bodies = read_all(schema::body());
    scene.stages = read_stages();
    scene.frictions = read_all(schema::friction());
    scene.bonds = read_all(schema::bond());
    if (const Entry* entry = document::find(root_, "cell")) {
      scene.cell.emplace().mark = entry->origin.mark;
      tables_.read(schema::cell(), entry->value, "cell", "", *scene.cell);
    }
    read_one(schema::contact(), scene.contact);
    read_one(schema::element(), scene.element);
    read_one(schema::time(), scene.time);
    read_one(schema::output(), scene.output);
    read_one(schema::limits(), scene.limits);
  }

  void read_afm(AfmScene& afm) {
    read_one(schema::lever(), afm.lever);
    read_one(schema::tip(), afm.tip);
    read_one(schema::laser(), afm.laser);
    read_one(schema::detector(), afm.detector);
    if (document::find(root_, "surface") != nullptr)
      read_one(schema::surface(), afm.target.emplace());
    afm.actions = read_all(schema::action());
  }

  // Including their flow laws.
  std::vector<MaterialSpec> read_materials() {
    std::vector<MaterialSpec> materials = read_all(schema::material());
    const Array& elements = array_at("material");
    for (std::size_t i = 0; i < materials.size(); ++i) {
      const Table& table = elements[i].get<Table>();
      const std::string path = numbered("material", i);
      materials[i].flow = read_flow_law(table, path);
      if (const Entry* damping = document::find(table, "damping"))
        tables_.read(schema::material_damping(), damping->value, path + ".damping", family_,
                     materials[i]);
    }
    return materials;
  }

  std::shared_ptr<const FlowLaw> read_flow_law(const Table& material, const std::string& path) {
    const Entry* hardening = document::find(material, "hardening");
    const Entry* rate = document::find(material, "rate");
    if (hardening == nullptr && rate == nullptr) return nullptr;
    auto law = std::make_shared<FlowLaw>();
    if (hardening != nullptr)
      tables_.read(schema::hardening(), hardening->value, path + ".hardening", "", *law);
    if (rate != nullptr) tables_.read(schema::rate(), rate->value, path + ".rate", "", *law);
    return law;
  }

  std::vector<ParticleSpec> read_particles(
      const schema::TableDeclaration<ParticleSpec>& declaration,
      const schema::TableDeclaration<ParticleSpec>& mesh_declaration) {
    std::vector<ParticleSpec> particles = read_all(declaration);
    const Array& elements = array_at("particle");
    for (std::size_t i = 0; i < particles.size(); ++i) {
      const Table& table = elements[i].get<Table>();
      const Entry* mesh = document::find(table, "mesh");
      if (const std::string* shape = shape_of(table); mesh != nullptr && shape != nullptr)
        tables_.read(mesh_declaration, mesh->value, numbered("particle", i) + ".mesh", *shape,
                     particles[i]);
    }
    return particles;
  }

  // Its `outline` or `shape`. A misspelt one is reported once; the keys of its mesh cannot be checked then.
  const std::string* shape_of(const Table& particle) const {
    const schema::TableView& view = *schema::find_table("particle", language_);
    const std::string* shape = document::find_text(particle, view.info.selector);
    const auto& known = schema::find_key(view, view.info.selector)->choices;
    const bool is_known =
        shape != nullptr && std::ranges::find(known, *shape, &schema::Choice::word) != known.end();
    return is_known ? shape : nullptr;
  }

  void read_grains(std::vector<ParticleSpec>& particles) {
    const Array& elements = array_at("particle");
    for (std::size_t i = 0; i < particles.size(); ++i)
      if (const Entry* grains = document::find(elements[i].get<Table>(), "grains"))
        tables_.read(schema::grains(), grains->value, numbered("particle", i) + ".grains", "",
                     particles[i].grains.emplace());
  }

  std::vector<StageSpec> read_stages() {
    std::vector<StageSpec> stages = read_all(schema::stage());
    const Array& elements = array_at("stage");
    for (std::size_t i = 0; i < stages.size(); ++i) {
      const Table& table = elements[i].get<Table>();
      const std::string path = numbered("stage", i);
      stages[i].moves = read_elements(schema::move(), table, path);
      stages[i].servos = read_elements(schema::servo(), table, path);
      if (const Entry* entry = document::find(table, "until")) {
        stages[i].until.emplace().mark = entry->origin.mark;
        tables_.read(schema::until(), entry->value, path + ".until", "", *stages[i].until);
      }
      if (const Entry* entry = document::find(table, "cell")) {
        stages[i].cell.emplace().mark = entry->origin.mark;
        tables_.read(schema::cell_drive(), entry->value, path + ".cell", "", *stages[i].cell);
      }
    }
    return stages;
  }

  std::vector<PackingSpec> read_packings() {
    std::vector<PackingSpec> packings = read_all(schema::packing());
    const Array& elements = array_at("packing");
    for (std::size_t i = 0; i < packings.size(); ++i)
      packings[i].classes =
          read_elements(schema::mixture_class(), elements[i].get<Table>(), numbered("packing", i));
    return packings;
  }

  static std::string numbered(const std::string& name, std::size_t i) {
    return fmt::format("{}[{}]", name, i);
  }

  template <class Spec>
  std::vector<Spec> read_all(const schema::TableDeclaration<Spec>& declaration) {
    return read_elements(declaration, root_, "");
  }

  template <class Spec>
  std::vector<Spec> read_elements(const schema::TableDeclaration<Spec>& declaration,
                                  const Table& parent, const std::string& parent_path) {
    const Array& elements = tables_.elements(parent, parent_path, declaration.info);
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
    if (const Entry* entry = document::find(root_, declaration.info.path))
      tables_.read(declaration, entry->value, declaration.info.path, "", spec);
  }

  // A table that read_all has found to be an array of tables, or to be missing.
  const Array& array_at(const std::string& name) const {
    static const Array none;
    const Entry* entry = document::find(root_, name);
    const bool usable = entry != nullptr && document::is_array_of_tables(entry->value);
    return usable ? entry->value.get<Array>() : none;
  }

  const Table& root_;
  const schema::Language& language_;
  std::string family_;
  schema::TableReader tables_;
};

}  // namespace

Scene read_tables(const Table& root, const std::filesystem::path& file, Problems& problems,
                  schema::Origins& origins) {
  SceneReader reader(root, problems);
  Scene scene = reader.read(file);
  origins = reader.origins();
  return scene;
}

}  // namespace pulvis
