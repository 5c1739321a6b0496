// study.toml, probe.toml or fit.toml of a folder of results, and the copies of the files that it names.
#pragma once

#include <filesystem>

#include "scenes/whole_settings.hpp"

namespace pulvis {

// Copies of an earlier state of the files are replaced, those that are named no longer go; a file that Pulvis did not write is not: ForeignFile.
void save_settings(const std::filesystem::path& file, const char* role,
                   const WholeSettings& settings);

}  // namespace pulvis
