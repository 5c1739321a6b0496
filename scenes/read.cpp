#include "scenes/read.hpp"
#include "scenes/spec/afm_scene.hpp"

#include "engine/files/input_file.hpp"
#include "engine/files/xxh3.hpp"
#include "scenes/checks/accuracy.hpp"
#include "scenes/checks/checks.hpp"
#include "scenes/checks/expect_checks.hpp"
#include "scenes/checks/state_checks.hpp"
#include "scenes/fill_die.hpp"
#include "scenes/grains/grains.hpp"
#include "scenes/keys/tables.hpp"
#include "scenes/language/extends.hpp"
#include "scenes/language/override.hpp"
#include "scenes/language/scene_text.hpp"
#include "scenes/language/table_reader.hpp"
#include "scenes/let/let.hpp"
#include "scenes/lever/afm_checks.hpp"
#include "scenes/lever/mesh/meshed_lever.hpp"
#include "scenes/lever/mesh/meshed_tip.hpp"
#include "scenes/materials/library.hpp"
#include "scenes/packing/fill_packings.hpp"
#include "scenes/scene_files.hpp"
#include "scenes/spec/flow_laws.hpp"
#include "scenes/tools/profile.hpp"
#include "systems/laws/flow_law.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace pulvis {
namespace {

using document::Array;
using document::Table;
using document::Value;

class SceneReader {
 public:
  SceneReader(const Table& root, Problems& problems)
      : root_(root), tables_(root, problems, schema::scene_language()) {}

  Scene read(const std::filesystem::path& file) {
    Scene scene;
    scene.file = file;
    tables_.read(schema::top_level(), Value{root_, {{1, 1}, -1}}, "", "", scene);
    if (const std::string* family = document::find_text(root_, "family")) family_ = *family;
    scene.materials = read_materials();
    if (scene.afm) {
      read_afm(*scene.afm);
      scene.expects = read_all(schema::expect());
      return scene;
    }
    scene.particles = read_particles();
    scene.bodies = read_all(schema::body());
    scene.packings = read_packings();
    scene.tools = read_all(schema::tool());
    scene.stages = read_stages();
    scene.frictions = read_all(schema::friction());
    scene.bonds = read_all(schema::bond());
    if (const document::Entry* entry = document::find(root_, "cell")) {
      scene.cell.emplace().mark = entry->origin.mark;
      tables_.read(schema::cell(), entry->value, "cell", "", *scene.cell);
    }
    read_one(schema::contact(), scene.contact);
    read_one(schema::element(), scene.element);
    read_one(schema::time(), scene.time);
    read_one(schema::output(), scene.output);
    read_one(schema::limits(), scene.limits);
    scene.expects = read_all(schema::expect());
    return scene;
  }

  const schema::Origins& origins() const { return tables_.origins(); }

 private:
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
    if (const document::Entry* entry = document::find(root_, declaration.info.path))
      tables_.read(declaration, entry->value, declaration.info.path, "", spec);
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

  std::vector<MaterialSpec> read_materials() {
    std::vector<MaterialSpec> materials = read_all(schema::material());
    const Array& elements = array_at("material");
    for (std::size_t i = 0; i < materials.size(); ++i) {
      const Table& table = elements[i].get<Table>();
      if (const document::Entry* entry = document::find(table, "damping"))
        tables_.read(schema::material_damping(), entry->value, numbered("material", i) + ".damping",
                     family_, materials[i]);
      materials[i].flow = read_flow_law(table, numbered("material", i));
    }
    return materials;
  }

  std::shared_ptr<const FlowLaw> read_flow_law(const Table& material, const std::string& path) {
    const document::Entry* hardening = document::find(material, "hardening");
    const document::Entry* rate = document::find(material, "rate");
    if (hardening == nullptr && rate == nullptr) return nullptr;
    auto law = std::make_shared<FlowLaw>();
    if (hardening != nullptr)
      tables_.read(schema::hardening(), hardening->value, path + ".hardening", "", *law);
    if (rate != nullptr) tables_.read(schema::rate(), rate->value, path + ".rate", "", *law);
    return law;
  }

  std::vector<ParticleSpec> read_particles() {
    std::vector<ParticleSpec> particles = read_all(schema::particle());
    const Array& elements = array_at("particle");
    for (std::size_t i = 0; i < particles.size(); ++i) {
      const Table& table = elements[i].get<Table>();
      const document::Entry* mesh = document::find(table, "mesh");
      const std::string* outline = document::find_text(table, "outline");
      if (mesh != nullptr && outline != nullptr && holds_outline(*outline))
        tables_.read(schema::mesh(), mesh->value, numbered("particle", i) + ".mesh", *outline,
                     particles[i]);
      if (const document::Entry* grains = document::find(table, "grains"))
        tables_.read(schema::grains(), grains->value, numbered("particle", i) + ".grains", "",
                     particles[i].grains.emplace());
    }
    return particles;
  }

  // A misspelt outline is reported once; the keys of its mesh cannot be judged then.
  static bool holds_outline(const std::string& outline) {
    const schema::KeyInfo& key =
        *schema::find_key(*schema::find_table("particle", schema::scene_language()), "outline");
    for (const schema::Choice& choice : key.choices)
      if (choice.word == outline) return true;
    return false;
  }

  std::vector<StageSpec> read_stages() {
    std::vector<StageSpec> stages = read_all(schema::stage());
    const Array& elements = array_at("stage");
    for (std::size_t i = 0; i < stages.size(); ++i) {
      const Table& table = elements[i].get<Table>();
      const std::string path = numbered("stage", i);
      stages[i].moves = read_elements(schema::move(), table, path);
      stages[i].servos = read_elements(schema::servo(), table, path);
      if (const document::Entry* entry = document::find(table, "until")) {
        stages[i].until.emplace().mark = entry->origin.mark;
        tables_.read(schema::until(), entry->value, path + ".until", "", *stages[i].until);
      }
      if (const document::Entry* entry = document::find(table, "cell")) {
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

  // Of a table that read_all has found to be an array of tables, or to be missing.
  const Array& array_at(const std::string& name) const {
    static const Array none;
    const document::Entry* entry = document::find(root_, name);
    const bool usable = entry != nullptr && document::is_array_of_tables(entry->value);
    return usable ? entry->value.get<Array>() : none;
  }

  const Table& root_;
  std::string family_;
  schema::TableReader tables_;
};

[[noreturn]] void refuse_file(const std::filesystem::path& file, const std::string& message) {
  throw SceneError({{file.string(), 1, 1, "", "scene", message}});
}

// Of all that decides on what a state has in it, and on how the powder answers.
std::uint64_t powder_hash(Table root) {
  for (document::Entry& entry : root)
    if (entry.key == "output" && entry.value.as<Table>() != nullptr)
      std::erase_if(entry.value.get<Table>(), [](const document::Entry& key) {
        return key.key == "samples" || key.key == "frames";
      });
  std::erase_if(root, [](const document::Entry& entry) {
    constexpr std::array others{"title", "initial_state", "stage", "expect", "limits"};
    return std::ranges::find(others, entry.key) != others.end();
  });
  return scene_hash(scene_text(root, schema::scene_language()));
}

// What an accuracy asked for stands in the meshes, and what the scene is expected to do does not concern the
// one that is compared with it.
void make_complete(LoadedScene& loaded, Table& root, const OtherScenes& others, bool alone) {
  std::erase_if(root, [&](const document::Entry& entry) {
    return entry.key == "accuracy" || (alone && entry.key == "expect");
  });
  loaded.text_in_place = scene_text(root, schema::scene_language());
  loaded.inputs =
      keep_inputs(root, loaded.scene.file.parent_path(), others, schema::scene_language());
  loaded.text = scene_text(root, schema::scene_language());
  loaded.powder_hash = powder_hash(root);
  loaded.hash = hash_with_inputs(loaded.inputs, scene_hash(loaded.text));
}

// Files have been put together when overrides are applied.
void refuse_extending(const Table& root, Problems& problems) {
  if (const document::Entry* entry = document::find(root, "extends"))
    problems.add(entry->origin, "extends", "cannot be set here, allowed: in a scene's file");
}

// `alone`: without what is expected of it.
LoadedScene load(const std::string& text, const std::filesystem::path& file,
                 const std::vector<std::string>& overrides = {}, bool alone = false) {
  Problems problems(file, overrides);
  Table root = whole_tree(text, file, schema::scene_language(), problems);
  apply_overrides(root, overrides, problems);
  refuse_extending(root, problems);
  problems.throw_if_any();
  apply_let(root, schema::scene_language(), problems);
  problems.throw_if_any();
  fill_materials(root, schema::scene_language(), problems);
  fill_die(root, problems);
  problems.throw_if_any();
  fill_meshes(root, problems);
  schema::fill_defaults(root, schema::scene_language());

  LoadedScene loaded;
  SceneReader reader(root, problems);
  loaded.scene = reader.read(file);
  loaded.scene.extended = {problems.files().begin() + 1, problems.files().end()};
  problems.throw_if_any();
  complete_flow_laws(loaded.scene, reader.origins(), problems);
  problems.throw_if_any();
  if (loaded.scene.afm) {
    load_meshed_lever(loaded.scene, reader.origins(), problems);
    load_meshed_tip(loaded.scene, reader.origins(), problems);
    problems.throw_if_any();
    check_afm(loaded.scene, reader.origins(), problems);
  } else
    complete_and_check(loaded.scene, reader.origins(), problems);
  problems.throw_if_any();
  OtherScenes others;
  if (!alone) {
    const auto read_other = [&](const std::filesystem::path& other) {
      return (others[other] = load(toml_file_text(other), other, {}, true)).scene;
    };
    complete_and_check_expectations(loaded.scene, read_other, reader.origins(), problems);
    problems.throw_if_any();
  }
  fill_packings(loaded.scene, reader.origins(), problems);
  problems.throw_if_any();
  make_grains(loaded.scene, reader.origins(), problems);
  problems.throw_if_any();
  make_profiles(loaded.scene, reader.origins(), problems);
  problems.throw_if_any();
  make_complete(loaded, root, others, alone);
  check_initial_state(loaded.scene, loaded.powder_hash, reader.origins(), problems);
  problems.throw_if_any();
  return loaded;
}

}  // namespace

std::string toml_file_text(const std::filesystem::path& file, const char* kind) {
  try {
    return text_of_input(file, document::largest_file);
  } catch (const UnfitInput& unfit) {
    refuse_file(file, fmt::format("{}, allowed: {} (TOML)", unfit.what(), kind));
  }
}

LoadedScene load_scene_text(const std::string& text, const std::filesystem::path& file,
                            const std::vector<std::string>& overrides) {
  return load(text, file, overrides);
}

LoadedScene load_scene(const std::filesystem::path& file,
                       const std::vector<std::string>& overrides) {
  return load_scene_text(toml_file_text(file), file, overrides);
}

Scene read_scene(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  return load_scene(file, overrides).scene;
}

Scene read_scene_alone(const std::filesystem::path& file) {
  return load(toml_file_text(file), file, {}, true).scene;
}

std::uint64_t scene_hash(const std::string& text) { return xxh3(std::as_bytes(std::span(text))); }

}  // namespace pulvis
