#include "cli/report/report_solid.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <optional>

#include "cli/report/report_encoding.hpp"
#include "cli/report/report_frames.hpp"

namespace pulvis {
namespace {

using Json = nlohmann::ordered_json;
using Face = std::array<std::int32_t, 4>;

constexpr std::size_t max_solid_frames = 60;
constexpr std::array<std::array<std::size_t, 4>, 6> faces_of_cell{
    {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};

struct Surface {
  std::vector<std::int32_t> faces, parts;  // four nodes per face; its part
};

// Key shared by both cells at a face. A triangle, from hexahedra collapsed to tetrahedra, has the same key
// whichever corner is repeated; nothing if less than a triangle is left.
std::optional<Face> key_of(Face face) {
  std::ranges::sort(face);
  const auto repeated = std::unique(face.begin(), face.end());
  if (repeated - face.begin() < 3) return {};
  std::fill(repeated, face.end(), -1);
  return face;
}

// Faces that belong to only one hexahedron.
Surface surface_of(const std::vector<std::int32_t>& hexahedra,
                   const std::vector<std::int32_t>& part) {
  struct Seen {
    Face face{};
    std::int32_t part = 0, count = 0;
  };
  std::map<Face, Seen> seen;
  for (std::size_t cell = 0; cell < part.size(); ++cell)
    for (const auto& corners : faces_of_cell) {
      Face face{};
      for (std::size_t k = 0; k < 4; ++k) face[k] = hexahedra[8 * cell + corners[k]];
      const auto key = key_of(face);
      if (!key) continue;
      Seen& one = seen[*key];
      one = {face, part[cell], one.count + 1};
    }
  Surface surface;
  for (const auto& [key, one] : seen) {
    if (one.count > 1) continue;
    surface.faces.insert(surface.faces.end(), one.face.begin(), one.face.end());
    surface.parts.push_back(one.part);
  }
  return surface;
}

// Nodes of the surface are renumbered, in mesh order.
std::vector<std::size_t> renumber(std::vector<std::int32_t>& faces) {
  std::map<std::int32_t, std::int32_t> number;
  for (const auto node : faces) number[node] = 0;
  std::vector<std::size_t> nodes;
  for (auto& [node, as] : number) {
    as = static_cast<std::int32_t>(nodes.size());
    nodes.push_back(static_cast<std::size_t>(node));
  }
  for (auto& node : faces) node = number[node];
  return nodes;
}

}  // namespace

std::vector<std::int32_t> surface_faces(const hdf5::File& file) {
  return surface_of(file.read_integers("/mesh/hexahedra"),
                    file.read_integers("/mesh/cell_particle"))
      .faces;
}

void add_solid(const hdf5::File& file, Json& head, std::vector<ReportSection>& sections) {
  const auto part = file.read_integers("/mesh/cell_particle");
  Surface surface = surface_of(file.read_integers("/mesh/hexahedra"), part);
  const auto nodes = renumber(surface.faces);
  const auto reference = file.read_doubles("/mesh/reference");
  const auto of_surface = [&](const std::vector<double>& position, double less) {
    std::vector<float> values;
    for (const auto node : nodes)
      for (std::size_t k = 3 * node; k < 3 * node + 3; ++k)
        values.push_back(static_cast<float>(position[k] - less * reference[k]));
    return values;
  };
  sections.push_back({"faces", encoded(std::span<const std::int32_t>(surface.faces), 4)});
  sections.push_back({"parts", encoded(std::span<const std::int32_t>(surface.parts), 1)});
  sections.push_back({"reference", encoded(of_surface(reference, 0))});
  const auto names = complete_frames(file);
  head["solid"] = {{"nodes", reference.size() / 3}, {"cells", part.size()}};
  head["all_frames"] = names.size();
  head["frames"] = Json::array();
  for (const auto i : thinned(names.size(), max_solid_frames)) {
    const std::string frame = "/frames/" + names[i];
    const auto section = "frame-" + std::to_string(head["frames"].size()) + "-displacement";
    sections.push_back({section, encoded(of_surface(file.read_doubles(frame + "/position"), 1))});
    head["frames"].push_back({{"time", file.number_attribute(frame, "time")},
                              {"step", file.number_attribute(frame, "step")}});
  }
}

}  // namespace pulvis
