// The files that a scene (or the settings of a reduction) names beside its own: outlines, packings, sieve
// curves, profiles, height maps, meshes, records, other scenes. They are found by their keys' kind. A run's
// folder keeps a copy of each, and the paths in its scene.toml lead to the copies: it can be checked and
// resumed wherever it lies.
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
using OtherScenes = std::map<std::filesystem::path, LoadedScene>;  // that a scene is compared with

struct InputFile {
  std::filesystem::path source;
  std::filesystem::path copy;       // from the run's folder
  std::optional<std::string> text;  // of the copy, where it is not the source's own
  std::uint64_t hash = 0;           // of what is in it
};

// Lets every path in `root`, so far from `folder`, lead to the file's copy. A copy's name ends in the hash
// of what is in it, heights-5f0c2a91.csv: files of one name do not collide, and a copy keeps its name when it
// is copied again.
std::vector<InputFile> keep_inputs(document::Table& root, const std::filesystem::path& folder,
                                   const OtherScenes& others, const schema::Language& language);

// What the user called the scene that `path` leads to: "disc.toml" of inputs/disc-5f0c2a91/scene.toml; a path that
// leads to no copy as it is.
std::string name_before_copying(const std::filesystem::path& path);

std::uint64_t file_hash(const std::filesystem::path& file);

// Goes on from `hash`: a scene whose tables have changed is another one.
std::uint64_t hash_with_inputs(const std::vector<InputFile>& inputs, std::uint64_t hash);

}  // namespace pulvis
