// The raster images of a run as embedded in the report: levelled and drawn by cli/report/page/panel_raster.js.
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "cli/report/report_data.hpp"
#include "engine/files/hdf5.hpp"

namespace pulvis {

// Adds "images" to the head, if the run has any. Of images finer than a screen only every second (third ...) pixel
// and line is kept, and the head says so.
void add_images(const hdf5::File& file, nlohmann::ordered_json& head,
                std::vector<ReportSection>& sections);

}  // namespace pulvis
