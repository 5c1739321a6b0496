// What kind of TOML file a command was given by mistake.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace pulvis {

// Where `command` cannot read the file, but another command can: what the file is, and how it is run. By the names of
// its top-level tables and keys alone.
std::optional<std::string> other_kind(const std::string& command,
                                      const std::filesystem::path& file);

}  // namespace pulvis
