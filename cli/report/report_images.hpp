// The pictures of rasters as the report carries them: levelled and drawn by cli/report/page/panel_raster.js.
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "cli/report/report_data.hpp"
#include "engine/files/hdf5.hpp"

namespace pulvis {

// Adds "images" to the head, where the run has any. Of pictures finer than a screen every second (third ...) pixel
// and line is kept, and the head says so.
void add_images(const hdf5::File& file, nlohmann::ordered_json& head,
                std::vector<ReportSection>& sections);

}  // namespace pulvis
