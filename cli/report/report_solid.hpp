// The frames of a lever in three dimensions as the report carries them: the faces of its surface and how
// far their corners have moved.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <vector>

#include "cli/report/report_data.hpp"
#include "engine/files/hdf5.hpp"

namespace pulvis {

// Faces that one hexahedron alone has, four nodes of the mesh each.
std::vector<std::int32_t> surface_faces(const hdf5::File& file);

void add_solid(const hdf5::File& file, nlohmann::ordered_json& head,
               std::vector<ReportSection>& sections);

}  // namespace pulvis
