// The report page of the conversion from an AFM's volts to friction.
#pragma once

#include <filesystem>

#include "cli/laboratory/output/volts_files.hpp"

namespace pulvis {

void write_volts_report(const std::filesystem::path& folder, const VoltsReduction& reduction);

}  // namespace pulvis
