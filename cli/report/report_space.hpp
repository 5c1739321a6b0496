// The frames of particles in three dimensions as embedded in the report: positions and values of the drawn mesh, the
// surfaces of the tools, the density along z.
//
// Positions are 16-bit numbers; those of later frames are differences from the first frame, which are similar among
// neighbours. Frames are thinned evenly, always keeping the last, to fit the budget; if that leaves too
// few for an animation, particles become pyramids (cli/report/report_space_mesh.hpp), and the head says so.
#pragma once

#include <nlohmann/json.hpp>

#include "cli/report/report_data.hpp"
#include "engine/files/hdf5.hpp"

namespace pulvis {

// Whether the run has particles in three dimensions, rather than a lever.
bool has_particles_in_space(const hdf5::File& file);

// Adds "mesh", "frames", "fields", "low", "high", and "tags" and "tools" if present, to the head. `budget`: bytes
// of the numbers before packing.
void add_space(const hdf5::File& file, std::size_t budget, nlohmann::ordered_json& head,
               std::vector<ReportSection>& sections);

}  // namespace pulvis
