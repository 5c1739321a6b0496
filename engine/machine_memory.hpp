// How much more memory this process may use: the minimum of what the machine has available, what its control
// groups (version 1 or 2, including all parent groups) allow, and what the shell's limit leaves.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace pulvis {

// Bytes; the largest representable number if there is no limit.
std::uint64_t available_memory();
std::uint64_t left_by_machine();  // shared by all processes: without the shell's limit
std::uint64_t left_by_shell();    // to this process alone

// Memory left by control groups. `table` is /proc/self/cgroup, `root` the mount point of the groups.
std::uint64_t left_by_control_groups(const std::filesystem::path& table,
                                     const std::filesystem::path& root);

std::string bytes_text(std::uint64_t bytes);  // "12.3 MB"

}  // namespace pulvis
