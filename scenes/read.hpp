// Reads a scene file. All errors in it are thrown as one SceneError, before anything
// is built or run.
#pragma once

#include "scenes/language/override.hpp"
#include "scenes/language/problem.hpp"
#include "scenes/scene_files.hpp"
#include "scenes/spec/scene.hpp"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace pulvis {

struct LoadedScene {
  Scene scene;
  // The scene as run, as TOML: with the base files, overrides and defaults merged, in one fixed layout. It is
  // self-contained: its paths lead to copies of the files that it names, as a run's folder keeps them.
  std::string text;
  // The same with paths relative to the folder of the scene's file.
  std::string text_in_place;
  std::vector<InputFile> inputs;
  std::vector<ReplacedOverride>
      replaced;  // overrides without effect, as a later one sets the same key
  // Of the powder alone, with its contacts and materials: scenes that differ only in stages and results share it, and
  // may start from each other's states.
  std::uint64_t powder_hash = 0;
  // Of that text and those files: the same for all scenes with the same content.
  std::uint64_t hash = 0;
};

LoadedScene load_scene(const std::filesystem::path& file,
                       const std::vector<std::string>& overrides = {});

// The same for a text that is already in memory; `file` is its name in messages.
LoadedScene load_scene_text(const std::string& text, const std::filesystem::path& file,
                            const std::vector<std::string>& overrides = {});

Scene read_scene(const std::filesystem::path& file, const std::vector<std::string>& overrides = {});

// A scene that another one is compared with: its own comparisons are not followed.
Scene read_scene_alone(const std::filesystem::path& file);

// The text of a file of at most 16 MiB; throws SceneError if it cannot be read.
std::string toml_file_text(const std::filesystem::path& file, const char* kind = "a scene");

// FNV-1a, 64 bits: the same on every machine.
std::uint64_t scene_hash(const std::string& text);

}  // namespace pulvis
