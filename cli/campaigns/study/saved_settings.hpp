// study.toml, probe.toml or fit.toml in a results folder, and copies of the files it refers to.
#pragma once

#include <filesystem>

#include "scenes/whole_settings.hpp"

namespace pulvis {

// Copies of an earlier version are replaced, unreferenced ones removed; files that Pulvis did not write are left: ForeignFile.
void save_settings(const std::filesystem::path& file, const char* role,
                   const WholeSettings& settings);

}  // namespace pulvis
