// Detects which kind of TOML file was passed to the wrong command.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace pulvis {

// If `command` cannot read the file but another command can: what the file is, and how to run it. Judged only by its
// top-level tables and keys.
std::optional<std::string> other_kind(const std::string& command,
                                      const std::filesystem::path& file);

}  // namespace pulvis
