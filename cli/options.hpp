// Options shared by several commands.
#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>
#include <vector>

namespace pulvis {

// "sub/../x" becomes x, whether or not a folder sub exists; symbolic links on the way are followed.
inline const CLI::Validator without_detours(
    [](std::string& text) {
      std::error_code unknown;
      const std::filesystem::path path(text);
      if (std::ranges::find(path, "..") == path.end()) return std::string();
      const auto straight = std::filesystem::weakly_canonical(path, unknown);
      if (!unknown) text = straight.string();
      return std::string();
    },
    "", "without_detours");

inline void add_overrides(CLI::App& command, std::vector<std::string>& overrides, const char* of) {
  command
      .add_option("--set", overrides,
                  fmt::format("change a key for {}: key.path=value, e.g. contact.friction=0.2", of))
      ->allow_extra_args(false)
      ->take_all();
}

}  // namespace pulvis
