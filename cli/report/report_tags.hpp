// What the report shows of a plane run besides its fields: the particle, material and class of each cell, and the
// outlines of the tools.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli/report/report_data.hpp"
#include "cli/report/report_mesh.hpp"
#include "engine/files/hdf5.hpp"

namespace pulvis {

// Adds "tags" and "tools" to the head if the run has them, and the particle of every drawn cell.
void add_tags(const hdf5::File& file, const PlaneMesh& mesh, const DrawnMesh& drawn,
              nlohmann::ordered_json& head, std::vector<ReportSection>& sections);

// The same for particles in space: only "tags", and for "tools" the pieces of their surfaces, four corner rows each.
void add_particle_tags(const hdf5::File& file, nlohmann::ordered_json& head,
                       std::vector<ReportSection>& sections);
void add_tool_faces(const hdf5::File& file, nlohmann::ordered_json& head,
                    std::vector<ReportSection>& sections);

std::vector<std::string> lines_of(const std::string& text);

// The corners of the tools in a frame.
void add_tool_corners(const hdf5::File& file, const std::string& frame, const std::string& prefix,
                      std::vector<ReportSection>& sections);

}  // namespace pulvis
