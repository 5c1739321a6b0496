// How much memory this process could still take: the least of what the machine has available, what its control
// groups (version 1 or 2, and all above them) allow and what the shell's limit leaves.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace pulvis {

std::uint64_t available_memory();  // bytes; the largest number where nothing says so

// What control groups leave. `table` is /proc/self/cgroup, `root` where the groups are mounted.
std::uint64_t left_by_control_groups(const std::filesystem::path& table,
                                     const std::filesystem::path& root);

std::string bytes_text(std::uint64_t bytes);  // "12.3 MB"

}  // namespace pulvis
