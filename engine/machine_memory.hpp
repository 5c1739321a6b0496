// How much memory this process could still take: the least of what the machine has available, what a control
// group allows and what the shell's limit leaves.
#pragma once

#include <cstdint>

namespace pulvis {

std::uint64_t available_memory();  // bytes; the largest number where nothing says so

}  // namespace pulvis
