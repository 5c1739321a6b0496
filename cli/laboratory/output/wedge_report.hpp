// The report page of a wedge calibration.
#pragma once

#include <filesystem>
#include "cli/laboratory/output/wedge_files.hpp"

namespace pulvis {

void write_wedge_report(const std::filesystem::path& folder, const WedgeReduction& reduction);

}  // namespace pulvis
