#include "engine/files/xdmf.hpp"

#include <fmt/format.h>

#include <map>
#include <utility>

#include "engine/files/own_files.hpp"

namespace pulvis {
namespace {

const std::string beginning =
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<Xdmf Version=\"3.0\">\n<Domain>\n";
constexpr const char* integers = R"(NumberType="Int" Precision="4")";
constexpr const char* doubles = R"(NumberType="Float" Precision="8")";

std::string escaped(const std::string& text) {
  static const std::map<char, const char*> entities = {
      {'&', "&amp;"}, {'<', "&lt;"}, {'>', "&gt;"}, {'"', "&quot;"}};
  std::string safe;
  for (const char c : text) {
    const auto entity = entities.find(c);
    entity == entities.end() ? safe += c : safe += entity->second;
  }
  return safe;
}

// Not Tensor6, which readers interpret as xx xy xz yy yz zz: stresses are stored as xx yy zz xy yz zx.
const char* attribute_type(int components) {
  if (components == 1) return "Scalar";
  if (components == 3) return "Vector";
  return components == 9 ? "Tensor" : "Matrix";
}

}  // namespace

bool is_of_mesh(const FieldInfo& field) {
  return field.place == FieldPlace::node || field.place == FieldPlace::cell;
}

int stored_components(const FieldInfo& field) {
  const bool vector = field.components == 2 && field.name != "position";
  return vector && is_of_mesh(field) ? 3 : field.components;
}

std::vector<double> with_zero_third(std::span<const double> plane) {
  std::vector<double> space(plane.size() / 2 * 3, 0.0);
  for (std::size_t i = 0; i < plane.size() / 2; ++i) {
    space[3 * i] = plane[2 * i];
    space[3 * i + 1] = plane[2 * i + 1];
  }
  return space;
}

Xdmf::Xdmf(std::filesystem::path path, std::string heavy, const RunMesh& mesh,
           const std::vector<FieldInfo>& fields)
    : path_(std::move(path)),
      heavy_(std::move(heavy)),
      nodes_(mesh.node_particle.size()),
      cells_(mesh.cell_particle.size()),
      in_space_(mesh.dimension() == 3),
      tool_pieces_(in_space_ ? mesh.tool_faces.tool.size() : mesh.tools.tool.size()),
      tool_points_(in_space_ ? mesh.tool_faces.points : mesh.tools.points()) {
  for (const ParticleTag& tag : mesh.tags)
    if (is_named(tag)) tags_.push_back(tag.name);
  for (const auto& field : fields) {
    if (is_of_mesh(field) && field.name != "position") fields_.push_back(field);
  }
}

// The powder last: meshio reads the last series of a file.
std::string Xdmf::text() const {
  const auto series = [](const char* name, const std::string& grids) {
    return fmt::format("<Grid Name=\"{}\" GridType=\"Collection\" CollectionType=\"Temporal\">\n",
                       name) +
           grids + "</Grid>\n";
  };
  return beginning + (tool_pieces_ > 0 ? series("tools", tool_grids_) : "") +
         series("run", grids_) + "</Domain>\n</Xdmf>\n";
}

void Xdmf::add(double time, const std::string& group) {
  grids_ += grid(time, group);
  if (tool_pieces_ > 0) tool_grids_ += tool_grid(time, group);
}

void Xdmf::write() {
  if (!std::exchange(is_noted_, true)) {
    require_own_or_none(path_, role::run);
    note_own(path_, role::run, beginning, Extent::start);
  }
  replace_own(path_, role::run, text());
}

void Xdmf::finish() const {
  if (is_noted_) note_own(path_, role::run, text(), Extent::whole);
}

std::string Xdmf::grid(double time, const std::string& group) const {
  std::string text = fmt::format(
      "<Grid Name=\"frame {}\" GridType=\"Uniform\">\n<Time Value=\"{:.17g}\"/>\n"
      "<Topology TopologyType=\"{}\" NumberOfElements=\"{}\">{}</Topology>\n"
      "<Geometry GeometryType=\"{}\">{}</Geometry>\n",
      group.substr(group.rfind('/') + 1), time, in_space_ ? "Hexahedron" : "Quadrilateral", cells_,
      item(in_space_ ? "/mesh/hexahedra" : "/mesh/quads", integers, cells_, in_space_ ? 8 : 4),
      in_space_ ? "XYZ" : "XY", item(group + "/position", doubles, nodes_, in_space_ ? 3 : 2));
  for (const auto& field : fields_) text += attribute(field, group);
  text += whole_numbers("particle", "/mesh/cell_particle", cells_);
  for (const std::string& tag : tags_) text += whole_numbers(tag, "/mesh/cell_" + tag, cells_);
  return text + "</Grid>\n";
}

std::string Xdmf::tool_grid(double time, const std::string& group) const {
  return fmt::format(
      "<Grid Name=\"tools {}\" GridType=\"Uniform\">\n<Time Value=\"{:.17g}\"/>\n"
      "<Topology TopologyType=\"{}\" NumberOfElements=\"{}\">{}</Topology>\n"
      "<Geometry GeometryType=\"{}\">{}</Geometry>\n{}</Grid>\n",
      group.substr(group.rfind('/') + 1), time,
      in_space_ ? "Quadrilateral" : "Polyline\" NodesPerElement=\"2", tool_pieces_,
      item(in_space_ ? "/tools/quads" : "/tools/lines", integers, tool_pieces_, in_space_ ? 4 : 2),
      in_space_ ? "XYZ" : "XY",
      item(group + "/tools/outline", doubles, tool_points_, in_space_ ? 3 : 2),
      whole_numbers("tool", in_space_ ? "/tools/quad_tool" : "/tools/line_tool", tool_pieces_));
}

std::string Xdmf::whole_numbers(const std::string& name, const std::string& dataset,
                                std::uint64_t count) const {
  return fmt::format(
      "<Attribute Name=\"{}\" AttributeType=\"Scalar\" Center=\"Cell\">{}</Attribute>\n", name,
      item(dataset, integers, count, 1));
}

std::string Xdmf::item(const std::string& dataset, const std::string& number, std::uint64_t rows,
                       int columns) const {
  const std::string extent =
      columns == 1 ? fmt::format("{}", rows) : fmt::format("{} {}", rows, columns);
  return fmt::format("<DataItem Format=\"HDF\" {} Dimensions=\"{}\">{}:{}</DataItem>", number,
                     extent, escaped(heavy_), escaped(dataset));
}

std::string Xdmf::attribute(const FieldInfo& field, const std::string& group) const {
  const bool on_nodes = field.place == FieldPlace::node;
  const int columns = stored_components(field);
  return fmt::format("<Attribute Name=\"{}\" AttributeType=\"{}\" Center=\"{}\">{}</Attribute>\n",
                     escaped(field.name), attribute_type(columns), on_nodes ? "Node" : "Cell",
                     item(group + "/" + field.name, doubles, on_nodes ? nodes_ : cells_, columns));
}

}  // namespace pulvis
