#include "scenes/read.hpp"
#include "engine/shortened.hpp"
#include "scenes/spec/afm_scene.hpp"

#include "engine/files/input_file.hpp"
#include "engine/files/xxh3.hpp"
#include "scenes/checks/accuracy.hpp"
#include "scenes/checks/contact_defaults.hpp"
#include "scenes/checks/expect_checks.hpp"
#include "scenes/checks/solids/accuracy.hpp"
#include "scenes/checks/state_checks.hpp"
#include "scenes/fill_die.hpp"
#include "scenes/grains/grains.hpp"
#include "scenes/keys/other_dimension.hpp"
#include "scenes/keys/scene_reader.hpp"
#include "scenes/language/extends.hpp"
#include "scenes/language/override.hpp"
#include "scenes/language/scene_text.hpp"
#include "scenes/let/let.hpp"
#include "scenes/lever/afm_checks.hpp"
#include "scenes/lever/mesh/meshed_lever.hpp"
#include "scenes/lever/mesh/meshed_tip.hpp"
#include "scenes/materials/library.hpp"
#include "scenes/packing/fill_packings.hpp"
#include "scenes/scene_checks.hpp"
#include "scenes/scene_files.hpp"
#include "scenes/spec/flow_laws.hpp"
#include "scenes/tools/profile.hpp"
#include "systems/laws/flow_law.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

namespace pulvis {
namespace {

using document::Table;

[[noreturn]] void refuse_file(const std::filesystem::path& file, const std::string& message) {
  throw SceneError({{file.string(), 1, 1, "", "scene", message}});
}

// Of everything that determines the contents of a state and the response of the powder.
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
  return scene_hash(scene_text(root, language_of(root)));
}

// The meshes already contain the effect of `accuracy`, two dimensions are the default, and expectations of a scene
// do not concern one that it is compared with.
void make_complete(LoadedScene& loaded, Table& root, const OtherScenes& others, bool alone) {
  const schema::Language& language = language_of(root);
  std::erase_if(root, [&](const document::Entry& entry) {
    return entry.key == "accuracy" || (entry.key == "dimension" && dimension_of(root) == 2) ||
           (alone && entry.key == "expect");
  });
  loaded.text_in_place = scene_text(root, language);
  loaded.inputs = keep_inputs(root, loaded.scene.file.parent_path(), others, language);
  loaded.text = scene_text(root, language);
  loaded.powder_hash = powder_hash(root);
  loaded.hash = hash_with_inputs(loaded.inputs, scene_hash(loaded.text));
}

bool names_one(const std::string& text, const Table& variables) {
  return std::ranges::any_of(variables, [&](const document::Entry& variable) {
    return text.find(variable.key) != std::string::npos;
  });
}

// Files have already been merged when overrides are applied.
void refuse_extending(const Table& root, Problems& problems) {
  if (const document::Entry* entry = document::find(root, "extends"))
    problems.add(entry->origin, "extends", "cannot be set here, allowed: in the scene file");
}

// A wrong one would have everything else read in the wrong language, which must be known before variables are.
void refuse_wrong_dimension(const Table& root, Problems& problems) {
  const document::Entry* entry = document::find(root, "dimension");
  if (entry == nullptr) return;
  const auto* number = entry->value.as<std::int64_t>();
  if (number != nullptr && (*number == 2 || *number == 3)) return;
  const auto* text = entry->value.as<std::string>();
  const document::Entry* let = document::find(root, "let");
  const Table* variables = let == nullptr ? nullptr : let->value.as<Table>();
  if (text != nullptr && variables != nullptr && names_one(*text, *variables))
    problems.add(entry->value.origin, "dimension",
                 "is an expression of variables, allowed: 2 or 3");
  else
    problems.add(entry->value.origin, "dimension",
                 fmt::format("{} is given, allowed: 2 or 3, without quotes",
                             shortened(document::value_text(entry->value))));
}

struct CompleteTree {
  Table root;
  std::optional<MissingWidth> missing_width;
};

// The complete tree with all its values.
CompleteTree complete_tree(const std::string& text, const std::filesystem::path& file,
                           const std::vector<std::string>& overrides, Problems& problems,
                           std::vector<ReplacedOverride>& replaced) {
  Table root = whole_tree(text, file, schema::scene_language(), problems);
  replaced = apply_overrides(root, overrides, problems);
  refuse_extending(root, problems);
  refuse_wrong_dimension(root, problems);
  problems.throw_if_any();
  const bool in_space = dimension_of(root) == 3;
  refuse_keys_of_other_dimension(root, problems);
  problems.throw_if_any();
  apply_let(root, language_of(root), problems);
  problems.throw_if_any();
  fill_materials(root, language_of(root), problems);
  std::optional<MissingWidth> missing_width = fill_die(root, problems);
  problems.throw_if_any();
  in_space ? space::fill_meshes(root, problems) : fill_meshes(root, problems);
  fill_contact(root, dimension_of(root));
  schema::fill_defaults(root, language_of(root));
  return {std::move(root), std::move(missing_width)};
}

Scene scene_of_tree(const CompleteTree& tree, const std::filesystem::path& file, Problems& problems,
                    schema::Origins& origins) {
  const Table& root = tree.root;
  Scene scene = read_tables(root, file, problems, origins);
  scene.extended = {problems.files().begin() + 1, problems.files().end()};
  problems.throw_if_any();
  if (tree.missing_width)
    problems.add(tree.missing_width->origin, "die.width", tree.missing_width->message);
  problems.throw_if_any();
  complete_flow_laws(scene, origins, problems);
  problems.throw_if_any();
  return scene;
}

void check_family(Scene& scene, const schema::Origins& origins, Problems& problems) {
  if (scene.afm) {
    load_meshed_lever(scene, origins, problems);
    load_meshed_tip(scene, origins, problems);
    problems.throw_if_any();
    check_afm(scene, origins, problems);
  } else {
    complete_and_check(scene, origins, problems);
  }
  problems.throw_if_any();
}

// Packings, grains and profiles.
void make_powder(Scene& scene, const schema::Origins& origins, Problems& problems) {
  fill_packings(scene, origins, problems);
  problems.throw_if_any();
  make_grains(scene, origins, problems);
  problems.throw_if_any();
  make_profiles(scene, origins, problems);
}

// `alone`: without its expectations.
LoadedScene load(const std::string& text, const std::filesystem::path& file,
                 const std::vector<std::string>& overrides = {}, bool alone = false) {
  Problems problems(file, overrides);
  LoadedScene loaded;
  CompleteTree tree = complete_tree(text, file, overrides, problems, loaded.replaced);
  schema::Origins origins;
  loaded.scene = scene_of_tree(tree, file, problems, origins);
  check_family(loaded.scene, origins, problems);
  OtherScenes others;
  if (!alone) {
    const auto read_other = [&](const std::filesystem::path& other) {
      return (others[other] = load(toml_file_text(other), other, {}, true)).scene;
    };
    complete_and_check_expectations(loaded.scene, read_other, origins, problems);
    problems.throw_if_any();
  }
  make_powder(loaded.scene, origins, problems);
  problems.throw_if_any();
  make_complete(loaded, tree.root, others, alone);
  check_initial_state(loaded.scene, loaded.powder_hash, origins, problems);
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
