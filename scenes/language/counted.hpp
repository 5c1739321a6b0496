// Counts with their noun: "1 stage", "2 stages".
#pragma once

#include <fmt/format.h>

#include <concepts>
#include <string>
#include <string_view>

namespace pulvis {

// `many`: the plural, if it is not the word plus s.
std::string counted(std::integral auto number, std::string_view one, std::string_view many = {}) {
  if (number == 1) return fmt::format("1 {}", one);
  return many.empty() ? fmt::format("{} {}s", number, one) : fmt::format("{} {}", number, many);
}

}  // namespace pulvis
