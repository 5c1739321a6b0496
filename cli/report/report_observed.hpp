// Local densities and contacts in the report, for frames that have them.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli/report/report_cell.hpp"
#include "cli/report/report_data.hpp"
#include "engine/files/hdf5.hpp"

namespace pulvis {

// Adds "density" and "network" to the frame's entry in the report's head, and the contact lines.
void add_observed(const hdf5::File& file, const std::string& frame, const std::string& prefix,
                  const ReportCell<TwoD>& cell, nlohmann::ordered_json& entry,
                  std::vector<ReportSection>& sections);

}  // namespace pulvis
