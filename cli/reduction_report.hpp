// The page of a reduction.
#pragma once

#include <filesystem>
#include "cli/reduction_files.hpp"

namespace pulvis {

void write_reduction_report(const std::filesystem::path& folder, const Reduction& reduction);

}  // namespace pulvis
