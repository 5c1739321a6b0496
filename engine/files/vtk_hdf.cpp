#include "engine/files/vtk_hdf.hpp"

#include <array>
#include <system_error>

#include "engine/files/output_error.hpp"
#include "engine/files/own_files.hpp"
#include "engine/files/xdmf.hpp"

namespace pulvis {
namespace {

namespace fs = std::filesystem;

// VTK's numbers of cell types (vtkCellType.h).
constexpr std::uint8_t line = 3, quad = 9, hexahedron = 12;

// Of a series of frames; a single one would be 1.0.
constexpr std::array<std::int64_t, 2> format_version{2, 0};

constexpr std::uint64_t mark_bytes = 512;
constexpr const char* mark = "pulvis run 1\n";

const std::string root = "/VTKHDF";

std::string group_of(const FieldInfo& field) {
  return field.place == FieldPlace::node ? "PointData" : "CellData";
}

VtkGrid powder(const RunMesh& mesh, const std::vector<FieldInfo>& fields) {
  const bool in_space = mesh.dimension() == 3;
  VtkGrid grid{"run.vtkhdf",
               "position",
               mesh.node_particle.size(),
               in_space ? "/mesh/hexahedra" : "/mesh/quads",
               {mesh.cell_particle.size(), in_space ? 8U : 4U},
               in_space ? hexahedron : quad,
               {},
               {{"particle", "/mesh/cell_particle"}}};
  for (const FieldInfo& field : fields)
    if (is_of_mesh(field) && field.name != "position") grid.fields.push_back(field);
  for (const ParticleTag& tag : mesh.tags)
    if (is_named(tag)) grid.constants.emplace_back(tag.name, "/mesh/cell_" + tag.name);
  return grid;
}

VtkGrid tools(const RunMesh& mesh) {
  const bool in_space = mesh.dimension() == 3;
  const std::size_t pieces = in_space ? mesh.tool_faces.tool.size() : mesh.tools.tool.size();
  return {"tools.vtkhdf",
          "tools/outline",
          in_space ? mesh.tool_faces.points : mesh.tools.points(),
          in_space ? "/tools/quads" : "/tools/lines",
          {pieces, in_space ? 4U : 2U},
          in_space ? quad : line,
          {},
          {{"tool", in_space ? "/tools/quad_tool" : "/tools/line_tool"}}};
}

std::uint64_t columns_for_vtk(std::uint64_t stored) {
  if (stored == 2) return 3;
  return stored == 4 ? 6 : stored;
}

}  // namespace

VtkHdf::VtkHdf(const fs::path& folder, std::string heavy, const RunMesh& mesh,
               const std::vector<FieldInfo>& fields)
    : heavy_(std::move(heavy)), dimension_(static_cast<std::uint64_t>(mesh.dimension())) {
  grids_.push_back(powder(mesh, fields));
  if (VtkGrid of_tools = tools(mesh); of_tools.corners.front() > 0)
    grids_.push_back(std::move(of_tools));
  for (VtkGrid& grid : grids_) grid.path = folder / grid.path;
}

void VtkHdf::add(double time, const std::string& group) {
  times_.push_back(time);
  groups_.push_back(group);
}

void VtkHdf::write() const {
  for (const VtkGrid& grid : grids_) write(grid);
}

void VtkHdf::write(const VtkGrid& grid) const {
  require_own_or_none(grid.path, role::run);
  const fs::path fresh = fresh_beside(grid.path);
  hdf5::File file = hdf5::File::create(fresh, mark_bytes);
  write_head(fresh, mark);
  file.make_group(root);
  file.set_attribute(root, "Version", format_version);
  file.set_plain_text(root, "Type", "UnstructuredGrid");
  write_mesh(file, grid);
  write_fields(file, grid);
  write_steps(file, grid);
  file.flush();
  file.close();
  std::error_code error;
  fs::rename(fresh, grid.path, error);
  if (error) throw OutputError(grid.path, "move the file to its final name", error.message());
}

void VtkHdf::write_mesh(hdf5::File& file, const VtkGrid& grid) const {
  const std::uint64_t cells = grid.corners[0], corners = grid.corners[1], ids = cells * corners;
  const auto write_number = [&](const char* name, std::uint64_t number) {
    const auto value = static_cast<std::int64_t>(number);
    file.write(root + "/" + name, std::span(&value, 1), {1});
  };
  write_number("NumberOfPoints", grid.number_of_points);
  write_number("NumberOfCells", cells);
  write_number("NumberOfConnectivityIds", ids);
  view(file, root + "/Points", grid.points, {grid.number_of_points, dimension_});
  const hdf5::Piece all{0, grid.cells, grid.corners};
  file.write_view(root + "/Connectivity", hdf5::Viewed::indices, {ids}, heavy_, {&all, 1});
  std::vector<std::int64_t> offsets(cells + 1);
  for (std::size_t i = 0; i < offsets.size(); ++i)
    offsets[i] = static_cast<std::int64_t>(corners * i);
  file.write(root + "/Offsets", offsets, {offsets.size()}, hdf5::Packing::shuffle_gzip);
  file.write_constant(root + "/Types", grid.cell_type, cells);
}

void VtkHdf::write_fields(hdf5::File& file, const VtkGrid& grid) const {
  for (const FieldInfo& field : grid.fields) {
    const std::uint64_t rows =
        field.place == FieldPlace::node ? grid.number_of_points : grid.corners[0];
    const auto columns = static_cast<std::uint64_t>(stored_components(field));
    view(file, root + "/" + group_of(field) + "/" + field.name, field.name,
         columns == 1 ? hdf5::Shape{rows} : hdf5::Shape{rows, columns});
  }
  for (const auto& [name, dataset] : grid.constants) {
    const hdf5::Piece all{0, dataset, {grid.corners[0]}};
    file.write_view(root + "/CellData/" + name, hdf5::Viewed::integers, {grid.corners[0]}, heavy_,
                    {&all, 1});
  }
}

void VtkHdf::write_steps(hdf5::File& file, const VtkGrid& grid) const {
  const std::string steps = root + "/Steps";
  const std::uint64_t count = times_.size();
  const std::vector<std::int64_t> zeros(count, 0), ones(count, 1);
  const auto write = [&](const std::string& name, const std::vector<std::int64_t>& values) {
    file.write(steps + "/" + name, values, {count});
  };
  file.make_group(steps);
  file.set_attribute(steps, "NSteps", static_cast<std::int64_t>(count));
  file.write(steps + "/Values", times_, {count});
  write("PartOffsets", zeros);  // one part, always the same
  write("NumberOfParts", ones);
  write("PointOffsets", rows_of_frames(grid.number_of_points));
  for (const char* const constant : {"CellOffsets", "ConnectivityIdOffsets"})
    file.write(steps + "/" + constant, zeros, {count, 1});  // a column for each kind of cells: one
  for (const FieldInfo& field : grid.fields)
    write(
        group_of(field) + "Offsets/" + field.name,
        rows_of_frames(field.place == FieldPlace::node ? grid.number_of_points : grid.corners[0]));
  for (const auto& [name, dataset] : grid.constants) write("CellDataOffsets/" + name, zeros);
}

// `name` of all frames, one below the other.
void VtkHdf::view(hdf5::File& file, const std::string& dataset, const std::string& name,
                  const hdf5::Shape& shape) const {
  const std::vector<std::int64_t> first = rows_of_frames(shape[0]);
  std::vector<hdf5::Piece> pieces;
  for (std::size_t i = 0; i < groups_.size(); ++i)
    pieces.push_back({static_cast<std::uint64_t>(first[i]), groups_[i] + "/" + name, shape});
  hdf5::Shape whole = shape;
  whole[0] *= groups_.size();
  if (whole.size() == 2) whole[1] = columns_for_vtk(whole[1]);
  file.write_view(dataset, hdf5::Viewed::reals, whole, heavy_, pieces);
}

// The first row of each frame among those of all.
std::vector<std::int64_t> VtkHdf::rows_of_frames(std::uint64_t rows) const {
  std::vector<std::int64_t> first;
  for (std::uint64_t newer = groups_.size(); newer-- > 0;)
    first.push_back(static_cast<std::int64_t>(newer * rows));
  return first;
}

}  // namespace pulvis
