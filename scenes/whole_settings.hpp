// Self-contained settings: those of a study, a probe or a fit, with copies of the files that they and their scenes name.
//
// The copies under inputs/ keep the relative locations of the files, so scenes are copied unchanged: their base files,
// variables and what a study changes in them keep their meaning. Only paths that would lead elsewhere are rewritten.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "scenes/language/schema.hpp"
#include "scenes/scene_files.hpp"

namespace pulvis {

struct WholeSettings {
  std::string text;  // its paths lead to the copies, relative to the folder that contains both
  std::vector<InputFile> inputs;
};

struct GivenSettings {
  const std::string& text;
  const std::filesystem::path& file;
  const schema::Language& language;
  // Files that the scenes have read: an override may name some that no scene file mentions.
  std::set<std::filesystem::path> read;
  std::vector<std::string> overrides;  // added to those of the file
};

WholeSettings whole_settings(const GivenSettings& given);

}  // namespace pulvis
