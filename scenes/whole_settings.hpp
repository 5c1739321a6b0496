// Settings that stand alone: those of a study, a probe or a fit, with copies of the files that they and their scenes name.
//
// The copies lie under inputs/ as the files lie to each other, so that scenes are copied as they are: what they extend, their
// variables and what a study changes in them keep their meaning. Only paths that would lead elsewhere are written anew.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "scenes/language/schema.hpp"
#include "scenes/scene_files.hpp"

namespace pulvis {

struct WholeSettings {
  std::string text;  // its paths lead to the copies, from the folder in which both lie
  std::vector<InputFile> inputs;
};

struct GivenSettings {
  const std::string& text;
  const std::filesystem::path& file;
  const schema::Language& language;
  // Files that the scenes have read: an override may name some that stand in no scene.
  std::set<std::filesystem::path> read;
  std::vector<std::string> overrides;  // join the file's own
};

WholeSettings whole_settings(const GivenSettings& given);

}  // namespace pulvis
