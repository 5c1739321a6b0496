// Breaking bonds in the report: sizes of the fragments, and in three dimensions where the bonds and cracks are.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli/report/report_cell.hpp"
#include "cli/report/report_data.hpp"
#include "engine/files/hdf5.hpp"

namespace pulvis {

constexpr std::size_t max_dots = 20'000;  // bonds drawn per frame, and cracks

// Size distribution of the fragments: diameters, and cumulative fractions of number and of area or volume up to each.
nlohmann::ordered_json fragments_of(const hdf5::File& file, const std::string& frame);

// Adds "fragments", "bonds" and "cracks" (how many there are) to the frame's entry in the report's head, and dots to
// draw: all of them, or if there are very many, every so many.
void add_space_bonds(const hdf5::File& file, const std::string& frame, const std::string& prefix,
                     const ReportCell<ThreeD>& cell, nlohmann::ordered_json& entry,
                     std::vector<ReportSection>& sections);

}  // namespace pulvis
