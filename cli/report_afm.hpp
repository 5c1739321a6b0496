// report.html of an AFM run: calibration beside the closed forms, force curve, friction loops.
#pragma once

#include <filesystem>

#include "cli/summary_afm.hpp"

namespace pulvis {

void write_afm_report(const std::filesystem::path& folder, const LoadedScene& loaded,
                      const AfmReport& report, const AfmHistory& history);

}  // namespace pulvis
