// The frames of a plane run as the report carries them: positions and values of the drawn mesh, and what
// was observed between the particles.
//
// Frames are thinned evenly, the last one always kept, to what fits into the budget. Where that leaves too
// few of them for a film, particles are thinned instead (cli/report/report_mesh.hpp), and the head says so.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli/report/report_data.hpp"
#include "engine/files/hdf5.hpp"

namespace pulvis {

// Adds "mesh", "frames", "fields", "low", "high" to the head. `budget`: bytes of the numbers before they
// are packed, which halves them or better.
void add_frames(const hdf5::File& file, std::size_t budget, nlohmann::ordered_json& head,
                std::vector<ReportSection>& sections);

// Names of the frames that are whole.
std::vector<std::string> complete_frames(const hdf5::File& file);

// At most `maximum` of `count` positions, evenly, the last one among them.
std::vector<std::size_t> thinned(std::size_t count, std::size_t maximum);

}  // namespace pulvis
