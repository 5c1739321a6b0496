#include "scenes/lever/mesh/gmsh_solid.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>

#include "scenes/language/problem.hpp"
#include "scenes/lever/mesh/gmsh_file.hpp"
#include "systems/lever/solid_tetrahedron_kernel.hpp"

namespace pulvis {
namespace {

constexpr double farthest = 1;  // m, of a node from the origin: no tip or lever is this large

using Facet = std::vector<int>;

// Faces of Gmsh's tetrahedron, which is numbered like the element (kernels::tetrahedron_edge).
constexpr std::array<std::array<std::size_t, 6>, 4> faces_of_tetrahedron{
    {{0, 1, 2, 4, 5, 6}, {0, 1, 3, 4, 9, 7}, {0, 2, 3, 6, 8, 7}, {1, 2, 3, 5, 8, 9}}};
constexpr std::array<std::array<std::size_t, 4>, 6> faces_of_hexahedron{
    {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};

Facet sorted(Facet facet) {
  std::ranges::sort(facet);
  return facet;
}

// Number of elements that have a face, by its sorted nodes.
template <class Elements, class Faces>
void count_faces(const Elements& elements, const Faces& faces, std::map<Facet, int>& count) {
  for (const auto& element : elements)
    for (const auto& face : faces) {
      Facet facet;
      for (const std::size_t c : face) facet.push_back(element[c]);
      ++count[sorted(facet)];
    }
}

class SolidReader {
 public:
  SolidReader(const std::filesystem::path& file, double unit, const GmshGroups& groups)
      : file_(file), groups_(groups), mesh_(read_gmsh(file)) {
    for (const auto& x : mesh_.nodes) {
      solid_.nodes.push_back(unit * x);
      const double far = solid_.nodes.back().cwiseAbs().maxCoeff();
      if (far > farthest)
        refuse(1, fmt::format("a node lies {:g} m away, allowed: up to {:g} m", far, farthest));
    }
  }

  GmshSolid read() {
    for (const auto& element : mesh_.volumes) take_volume(element);
    if (!solid_.hexahedra.empty() && !solid_.tetrahedra.empty())
      refuse(
          1,
          "has both hexahedra and tetrahedra, whose faces do not match, allowed: one of the two");
    take_surfaces();
    drop_unused();
    return std::move(solid_);
  }

 private:
  [[noreturn]] void refuse(int line, const std::string& message) const {
    refuse_mesh(file_, line, groups_.key, message);
  }

  Vec3 at(int node) const { return solid_.nodes[static_cast<std::size_t>(node)]; }

  void take_volume(const GmshMesh::Element& element) {
    const auto part = groups_.volumes.find(element.group);
    if (part == groups_.volumes.end()) {
      std::string allowed;
      for (const auto& [name, as] : groups_.volumes)
        allowed += (allowed.empty() ? "" : ", ") + name;
      refuse(element.line,
             fmt::format("the volume '{}' is unknown, allowed: {}", element.group, allowed));
    }
    if (element.nodes.size() == 8)
      take_hexahedron(element, part->second);
    else
      take_tetrahedron(element, part->second);
  }

  void take_hexahedron(const GmshMesh::Element& element, SolidPart part) {
    SolidMesh::Hexahedron corners;
    std::ranges::copy(element.nodes, corners.begin());
    if (!turn_outside_out(solid_.nodes, corners))
      refuse(
          element.line,
          fmt::format("a hexahedron of '{}' is inverted, allowed: positive volume at every corner",
                      element.group));
    solid_.hexahedra.push_back(corners);
    solid_.hexahedron_part.push_back(part);
  }

  void take_tetrahedron(const GmshMesh::Element& element, SolidPart part) {
    constexpr double flat = 1e-9, bent = 1e-6;  // -, of the longest edge
    SolidMesh::Tetrahedron nodes;
    std::ranges::copy(element.nodes, nodes.begin());
    double longest = 0;
    const auto corner = [&](int c) { return at(nodes[static_cast<std::size_t>(c)]); };
    for (const auto& [from, to] : kernels::tetrahedron_edge)
      longest = std::max(longest, (corner(to) - corner(from)).norm());
    const Vec3 a = at(nodes[1]) - at(nodes[0]), b = at(nodes[2]) - at(nodes[0]),
               c = at(nodes[3]) - at(nodes[0]);
    const double volume = a.cross(b).dot(c);
    if (!(std::abs(volume) > flat * longest * longest * longest))
      refuse(element.line,
             fmt::format("a tetrahedron of '{}' is flat, allowed: positive volume", element.group));
    int between = 4;
    for (const auto& [from, to] : kernels::tetrahedron_edge) {
      const Vec3 middle = 0.5 * (corner(from) + corner(to));
      if (!((corner(between++) - middle).norm() <= bent * longest))
        refuse(element.line,
               fmt::format("a tetrahedron of '{}' has a curved edge or a mid-side node that is not "
                           "at mid-side, allowed: straight edges (Mesh.SecondOrderLinear = 1)",
                           element.group));
    }
    if (volume < 0) {  // mirror image: corners 0 and 1 are swapped, with their edges
      std::swap(nodes[0], nodes[1]);
      std::swap(nodes[5], nodes[6]);
      std::swap(nodes[7], nodes[9]);
    }
    solid_.tetrahedra.push_back(nodes);
    solid_.tetrahedron_part.push_back(part);
  }

  void take_surfaces() {
    std::map<Facet, int> count;
    count_faces(solid_.hexahedra, faces_of_hexahedron, count);
    count_faces(solid_.tetrahedra, faces_of_tetrahedron, count);
    for (const auto& facet : mesh_.facets) {
      const auto group = groups_.surfaces.find(facet.group);
      if (group == groups_.surfaces.end()) continue;
      const auto found = count.find(sorted(facet.nodes));
      if (found == count.end() || (!group->second && found->second > 1))
        refuse(facet.line,
               fmt::format("an element of '{}' is not a face of a volume element{}, allowed: {}",
                           facet.group, group->second ? "" : ", or lies between two of them",
                           "surfaces of the volumes"));
      solid_.surfaces[facet.group].push_back(facet.nodes);
    }
  }

  // Nodes of points and lines that belong to no element would be unconnected.
  void drop_unused() {
    std::vector<int> place(solid_.nodes.size(), -1);
    std::vector<Vec3> kept;
    const auto rename = [&](auto& nodes) {
      for (auto& n : nodes) {
        int& to = place[static_cast<std::size_t>(n)];
        if (to < 0) {
          to = static_cast<int>(kept.size());
          kept.push_back(at(n));
        }
        n = to;
      }
    };
    for (auto& h : solid_.hexahedra) rename(h);
    for (auto& t : solid_.tetrahedra) rename(t);
    for (auto& [group, facets] : solid_.surfaces)
      for (auto& facet : facets) rename(facet);
    solid_.nodes = std::move(kept);
  }

  std::filesystem::path file_;
  const GmshGroups& groups_;
  GmshMesh mesh_;
  GmshSolid solid_;
};

}  // namespace

bool GmshSolid::has(SolidPart part) const {
  return std::ranges::find(hexahedron_part, part) != hexahedron_part.end() ||
         std::ranges::find(tetrahedron_part, part) != tetrahedron_part.end();
}

std::set<int> GmshSolid::nodes_of(const std::string& surface) const {
  std::set<int> of_surface;
  const auto found = surfaces.find(surface);
  if (found == surfaces.end()) return of_surface;
  for (const auto& facet : found->second) of_surface.insert(facet.begin(), facet.end());
  return of_surface;
}

void refuse_mesh(const std::filesystem::path& file, int line, const std::string& key,
                 const std::string& message) {
  throw SceneError({{file.string(), line, 1, "", key, message}});
}

GmshSolid read_gmsh_solid(const std::filesystem::path& file, double unit,
                          const GmshGroups& groups) {
  return SolidReader(file, unit, groups).read();
}

int add_gmsh_solid(SolidDraft& draft, const GmshSolid& solid, const Vec3& root,
                   HexFormulation formulation) {
  const auto first = static_cast<int>(draft.nodes.size());
  for (const Vec3& x : solid.nodes) draft.add_node(root + x);
  const auto moved = [&](auto nodes) {
    for (auto& node : nodes) node += first;
    return nodes;
  };
  for (std::size_t e = 0; e < solid.hexahedra.size(); ++e) {
    const SolidPart part = solid.hexahedron_part[e];
    const bool layer = part == SolidPart::lever || part == SolidPart::coating;
    draft.add_hexahedron(moved(solid.hexahedra[e]), part,
                         layer ? formulation : HexFormulation::solid);
  }
  for (std::size_t e = 0; e < solid.tetrahedra.size(); ++e)
    draft.add_tetrahedron(moved(solid.tetrahedra[e]), solid.tetrahedron_part[e]);
  return first;
}

}  // namespace pulvis
