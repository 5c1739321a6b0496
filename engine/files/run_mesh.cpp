#include "engine/files/run_mesh.hpp"

#include <fmt/format.h>

#include <string>
#include <vector>

#include "engine/files/describe.hpp"

namespace pulvis {
namespace {

std::string one_a_line(const std::vector<std::string>& names) {
  return fmt::format("{}", fmt::join(names, "\n"));
}

void write_tag(hdf5::File& file, const RunMesh& mesh, const ParticleTag& tag) {
  const auto write = [&](const std::string& name, const std::vector<std::int32_t>& values) {
    file.write(name, values, {values.size()}, hdf5::Packing::shuffle_gzip);
    describe(file, name, "-", tag.meaning, tag.label);
    if (is_named(tag)) file.set_attribute(name, "names", std::string_view(one_a_line(tag.names)));
  };
  const std::string of_particles = "/particles/" + tag.name;
  write(of_particles, tag.values);
  file.set_attribute(of_particles, "place", std::string_view("particle"));
  file.set_attribute(of_particles, "components", std::int64_t{1});
  if (!is_named(tag)) return;  // /mesh/cell_particle already has the numbers
  std::vector<std::int32_t> of_cells;
  for (const std::int32_t p : mesh.cell_particle)
    of_cells.push_back(tag.values.at(static_cast<std::size_t>(p)));
  write("/mesh/cell_" + tag.name, of_cells);
}

void write_tools(hdf5::File& file, const ToolLines& tools) {
  file.write("/tools/lines", tools.ends, {tools.tool.size(), 2});
  describe(file, "/tools/lines", "-",
           "rows of tools/outline connected by a line; the lines of each tool are closed");
  file.write("/tools/line_tool", tools.tool, {tools.tool.size()});
  describe(file, "/tools/line_tool", "-", "tool of the line, position in `names`");
  file.set_attribute("/tools/line_tool", "names", std::string_view(one_a_line(tools.names)));
}

void write_tools(hdf5::File& file, const ToolFaces& tools) {
  file.write("/tools/quads", tools.corners, {tools.tool.size(), 4});
  describe(file, "/tools/quads", "-",
           "rows of tools/outline, the corners of each surface piece; triangles repeat one");
  file.write("/tools/quad_tool", tools.tool, {tools.tool.size()});
  describe(file, "/tools/quad_tool", "-", "tool of the piece, position in `names`");
  file.set_attribute("/tools/quad_tool", "names", std::string_view(one_a_line(tools.names)));
  file.set_attribute("/tools/quad_tool", "kinds", std::string_view(one_a_line(tools.kinds)));
}

}  // namespace

void write_mesh(hdf5::File& file, const RunMesh& mesh) {
  constexpr auto packed = hdf5::Packing::shuffle_gzip;
  const std::uint64_t nodes = mesh.node_particle.size(), cells = mesh.cell_particle.size();
  const auto dimension = static_cast<std::uint64_t>(mesh.dimension());
  const bool in_space = dimension == 3;
  const std::string connectivity = in_space ? "/mesh/hexahedra" : "/mesh/quads";
  file.write(connectivity, in_space ? mesh.hexahedra : mesh.quads, {cells, in_space ? 8U : 4U},
             packed);
  describe(file, connectivity, "-",
           in_space ? "node numbers of each cell, in the order of VTK"
                    : "node numbers of each cell, counter-clockwise");
  file.write("/mesh/cell_particle", mesh.cell_particle, {cells}, packed);
  describe(file, "/mesh/cell_particle", "-", "particle each cell belongs to");
  file.write("/mesh/node_particle", mesh.node_particle, {nodes}, packed);
  describe(file, "/mesh/node_particle", "-", "particle each node belongs to");
  file.write("/mesh/reference", mesh.reference, {nodes, dimension}, packed);
  describe(file, "/mesh/reference", "m", "positions of the nodes before the first step");
  for (const ParticleTag& tag : mesh.tags) write_tag(file, mesh, tag);
  if (!mesh.tools.names.empty()) write_tools(file, mesh.tools);
  if (!mesh.tool_faces.names.empty()) write_tools(file, mesh.tool_faces);
}

}  // namespace pulvis
