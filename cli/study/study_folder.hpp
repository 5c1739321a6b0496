// The folder of a study: whose it is, and who is at work in it.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "engine/files/run_folder.hpp"
#include "scenes/study/study.hpp"

namespace pulvis {

// Refuses a folder in which files of somebody else, or the study itself, stand where the study would write.
void require_own_study(const std::filesystem::path& folder, const std::filesystem::path& study);

// Makes the folder. Two studies in one would take each other's runs away.
FolderLock lock_study(const std::filesystem::path& folder);

// study.toml, and copies of what it names.
void save_study(const std::filesystem::path& folder, const Study& study);

// Runs that somebody else does, and who: those that are known, and those whose folder a process is writing into.
std::map<std::string, std::string> runs_elsewhere(const std::filesystem::path& folder,
                                                  const Study& study,
                                                  std::map<std::string, std::string> known);

}  // namespace pulvis
