// The folder of a study: its owner, and which processes are working in it.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "cli/campaigns/study/analysis/study_spec.hpp"
#include "engine/files/run_folder.hpp"

namespace pulvis {

// Refuses a folder in which foreign files, or the study file itself, are where the study would write.
void require_own_study(const std::filesystem::path& folder, const std::filesystem::path& study);

// Creates the folder. Two studies in one folder would interfere with each other's runs.
FolderLock lock_study(const std::filesystem::path& folder);

// study.toml, and copies of the files it refers to.
void save_study(const std::filesystem::path& folder, const Study& study);

// Runs done by others, and by whom: the known ones, and those whose folder another process is writing to.
std::map<std::string, std::string> runs_elsewhere(const std::filesystem::path& folder,
                                                  const Study& study,
                                                  std::map<std::string, std::string> known);

}  // namespace pulvis
