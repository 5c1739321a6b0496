// The files that a scene (or the settings of a reduction) refers to: outlines, packings, sieve
// curves, profiles, height maps, meshes, records, other scenes. They are found by the kind of their keys. A run's
// folder keeps a copy of each, and the paths in its scene.toml lead to the copies: it can be checked and
// resumed wherever the folder is moved.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "scenes/language/schema.hpp"

namespace pulvis {

struct LoadedScene;
using OtherScenes = std::map<std::filesystem::path, LoadedScene>;  // scenes to compare with

struct InputFile {
  std::filesystem::path source;
  std::filesystem::path copy;       // relative to the run's folder
  std::optional<std::string> text;  // of the copy, where it differs from the source
  std::uint64_t hash = 0;           // of its contents
};

// Redirects every path in `root`, so far relative to `folder`, to the file's copy. A copy's name ends in the hash
// of its contents, heights-5f0c2a91.csv: files with equal names do not collide, and a copy keeps its name when it
// is copied again.
std::vector<InputFile> keep_inputs(document::Table& root, const std::filesystem::path& folder,
                                   const OtherScenes& others, const schema::Language& language);

// The user's name for the scene that `path` leads to: "disc.toml" for inputs/disc-5f0c2a91/scene.toml; a path that
// leads to no copy is returned unchanged.
std::string name_before_copying(const std::filesystem::path& path);

std::uint64_t file_hash(const std::filesystem::path& file);

// Continues from `hash`: a scene whose input tables have changed counts as a different one.
std::uint64_t hash_with_inputs(const std::vector<InputFile>& inputs, std::uint64_t hash);

}  // namespace pulvis
