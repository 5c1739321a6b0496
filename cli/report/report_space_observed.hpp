// Observed quantities of a run in three dimensions in the report: the contact network, densities in the cells of a grid.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli/report/report_cell.hpp"
#include "cli/report/report_data.hpp"
#include "engine/files/hdf5.hpp"

namespace pulvis {

// Adds to the entry of a frame ("/frames/N") and, as sections that begin with `prefix`, the numbers.
void add_space_observed(const hdf5::File& file, const std::string& frame, const std::string& prefix,
                        const ReportCell<ThreeD>& cell, nlohmann::ordered_json& entry,
                        std::vector<ReportSection>& sections);

}  // namespace pulvis
