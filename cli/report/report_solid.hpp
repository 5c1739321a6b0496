// The frames of a lever in three dimensions as embedded in the report: the faces of its surface and the
// displacements of their corners.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <vector>

#include "cli/report/report_data.hpp"
#include "engine/files/hdf5.hpp"

namespace pulvis {

// Faces that belong to only one hexahedron, four mesh nodes each.
std::vector<std::int32_t> surface_faces(const hdf5::File& file);

void add_solid(const hdf5::File& file, nlohmann::ordered_json& head,
               std::vector<ReportSection>& sections);

}  // namespace pulvis
