// The frames of a plane run as embedded in the report: positions and values of the drawn mesh, and what
// was observed between the particles.
//
// Frames are thinned evenly, always keeping the last, to fit the budget. If that leaves too
// few for a film, particles are simplified instead (cli/report/report_mesh.hpp), and the head says so.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli/report/report_data.hpp"
#include "engine/files/hdf5.hpp"

namespace pulvis {

// Adds "mesh", "frames", "fields", "low", "high" to the head. `budget`: bytes of the numbers before
// packing, which at least halves them.
void add_frames(const hdf5::File& file, std::size_t budget, nlohmann::ordered_json& head,
                std::vector<ReportSection>& sections);

// Names of the complete frames.
std::vector<std::string> complete_frames(const hdf5::File& file);

// At most `maximum` of `count` indices, evenly spaced, including the last.
std::vector<std::size_t> thinned(std::size_t count, std::size_t maximum);

}  // namespace pulvis
