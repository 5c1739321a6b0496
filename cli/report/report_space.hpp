// The frames of particles in three dimensions as the report carries them: positions and values of the drawn mesh, the
// surfaces of the tools, the density along z.
//
// Positions are numbers of 16 bits; those of later frames are differences from the first one, which are alike among
// neighbours. Frames are thinned evenly, the last one always kept, to what fits into the budget; where that leaves too
// few of them for a film, particles become pyramids (cli/report/report_space_mesh.hpp), and the head says so.
#pragma once

#include <nlohmann/json.hpp>

#include "cli/report/report_data.hpp"
#include "engine/files/hdf5.hpp"

namespace pulvis {

// Whether the run is of particles in three dimensions, and not of a lever.
bool has_particles_in_space(const hdf5::File& file);

// Adds "mesh", "frames", "fields", "low", "high" and what of "tags" and "tools" there is to the head. `budget`: bytes
// of the numbers before they are packed.
void add_space(const hdf5::File& file, std::size_t budget, nlohmann::ordered_json& head,
               std::vector<ReportSection>& sections);

}  // namespace pulvis
