#include "cli/save_scene.hpp"

#include <fstream>

#include "engine/files/input_file.hpp"
#include "engine/files/own_files.hpp"
#include "engine/files/run_folder.hpp"

namespace pulvis {
namespace {

namespace fs = std::filesystem;

bool holds(const fs::path& file, const InputFile& input) {
  if (!input.text) return file_hash(file) == input.hash;
  try {
    return text_of_input(file, input.text->size()) == *input.text;
  } catch (const UnfitInput&) {
    return false;
  }
}

// An incomplete copy never gets the final name.
void make_copy(const InputFile& input, const fs::path& target) {
  std::error_code error;
  fs::create_directories(target.parent_path(), error);
  const fs::path draft = fresh_beside(target);
  if (input.text)
    std::ofstream(draft, std::ios::binary) << *input.text;  // the result is checked below
  else if (!error)
    fs::copy_file(input.source, draft, fs::copy_options::overwrite_existing, error);
  if (!error && !holds(draft, input))
    throw OutputError(input.source, "keep a copy of it", "it has changed since it was read");
  if (!error) fs::rename(draft, target, error);
  if (error) throw OutputError(target, "keep a copy of " + input.source.string(), error.message());
}

}  // namespace

void save_inputs(const fs::path& folder, const std::vector<InputFile>& inputs) {
  for (const InputFile& input : inputs) {
    const fs::path target = folder / input.copy;
    if (!fs::exists(target))
      make_copy(input, target);
    else if (!holds(target, input))
      throw RunFolderTaken(target, "keep a copy of " + input.source.string() + " there",
                           "a different file is there already, allowed: another folder");
  }
}

void save_scene(const fs::path& folder, const LoadedScene& loaded) {
  save_inputs(folder, loaded.inputs);
  write_own(folder / "scene.toml", role::run, loaded.text);
}

void require_saved_scene(const fs::path& folder) {
  if (!fs::exists(folder / "scene.toml"))
    throw OutputError(folder / "scene.toml", "continue without the file", "it is no longer there");
}

LoadedScene as_saved(const fs::path& folder, LoadedScene loaded) {
  const document::Table root = document::parse(loaded.text);
  const document::Entry* expects = document::find(root, "expect");
  for (std::size_t i = 0; i < loaded.scene.expects.size(); ++i) {
    const auto& table = expects->value.get<document::Array>().at(i).get<document::Table>();
    if (const std::string* like = document::find_text(table, "like"))
      loaded.scene.expects[i].like = *like;
  }
  loaded.scene.file = folder / "scene.toml";
  return loaded;
}

}  // namespace pulvis
