// What report.html carries of local densities and of the contact network: those of the last frame.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli/report_data.hpp"
#include "engine/hdf5.hpp"

namespace pulvis {

// Adds to the head "density" and "network", where the frame ("/frames/000050") has them, and the numbers
// of the network as sections.
void add_observed(const hdf5::File& file, const std::string& frame, nlohmann::ordered_json& head,
                  std::vector<ReportSection>& sections);

}  // namespace pulvis
