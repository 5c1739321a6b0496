// The page of a reduction.
#pragma once

#include <filesystem>
#include "cli/laboratory/output/reduction_files.hpp"

namespace pulvis {

void write_reduction_report(const std::filesystem::path& folder, const Reduction& reduction);

}  // namespace pulvis
