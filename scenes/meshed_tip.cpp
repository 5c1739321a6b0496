#include "scenes/meshed_tip.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <set>

#include "scenes/gmsh_file.hpp"
#include "scenes/scene.hpp"

namespace pulvis {
namespace {

constexpr double farthest = 1;  // m, of a node from the axis: no tip is as large

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& message) {
  throw SceneError({{file.string(), 1, 1, "", "tip.file", message}});
}

void take_hexahedra(const GmshMesh& mesh, const std::filesystem::path& file, TipSolid& tip) {
  for (const auto& hexahedron : mesh.hexahedra) {
    if (hexahedron.group != "tip" && hexahedron.group != "glue")
      refuse(file, fmt::format("the volume '{}' is unknown, allowed: tip, glue", hexahedron.group));
    SolidMesh::Hexahedron corners;
    std::ranges::copy(hexahedron.corners, corners.begin());
    if (!turn_outside_out(tip.nodes, corners))
      refuse(file, fmt::format("hexahedron {} of '{}' is folded, allowed: positive volume at every "
                               "corner",
                               tip.hexahedra.size() + 1, hexahedron.group));
    tip.hexahedra.push_back(corners);
    tip.part.push_back(hexahedron.group == "tip" ? SolidPart::tip : SolidPart::glue);
  }
  if (tip.hexahedra.empty())
    refuse(file, "has no hexahedra in a volume named tip, allowed: a physical volume \"tip\"");
}

using Face = std::array<int, 4>;

Face sorted(Face face) {
  std::ranges::sort(face);
  return face;
}

// Faces that one hexahedron has alone.
std::set<Face> surface_of(const TipSolid& tip) {
  std::set<Face> surface;
  const auto meet = [&](const Face& face) {
    const auto [at, is_new] = surface.insert(sorted(face));
    if (!is_new) surface.erase(at);
  };
  for (const auto& h : tip.hexahedra) {
    meet({h[0], h[1], h[2], h[3]});
    meet({h[4], h[5], h[6], h[7]});
    for (std::size_t i = 0; i < 4; ++i) meet({h[i], h[(i + 1) % 4], h[i + 4], h[(i + 1) % 4 + 4]});
  }
  return surface;
}

void take_surfaces(const GmshMesh& mesh, const std::filesystem::path& file, TipSolid& tip) {
  const std::set<Face> surface = surface_of(tip);
  std::set<int> foot;
  for (const auto& quad : mesh.quads) {
    if (quad.group != "foot" && quad.group != "end") continue;
    if (!surface.contains(sorted(quad.corners)))
      refuse(file, fmt::format("a quad of '{}' is no face of a hexahedron, or lies between two, "
                               "allowed: surfaces of the volumes",
                               quad.group));
    if (quad.group == "foot") foot.insert(quad.corners.begin(), quad.corners.end());
    if (quad.group == "end") tip.end_faces.push_back(quad.corners);
  }
  if (foot.empty() || tip.end_faces.empty())
    refuse(file, "a surface is missing, allowed: physical surfaces \"foot\" and \"end\"");
  tip.foot.assign(foot.begin(), foot.end());
  for (const auto& face : tip.end_faces)
    for (const int n : face)
      tip.height = std::max(tip.height, -tip.nodes[static_cast<std::size_t>(n)].z());
  if (!(tip.height > 0)) refuse(file, "the end does not lie below z = 0, allowed: z < 0");
  for (const int n : tip.foot) {
    const Vec3& x = tip.nodes[static_cast<std::size_t>(n)];
    tip.reach = std::max(tip.reach, x.head<2>().cwiseAbs().maxCoeff());
    if (std::abs(x.z()) > 1e-6 * tip.height)
      refuse(file,
             fmt::format("the foot is at z = {:g} m, allowed: in z = 0, the end below it", x.z()));
  }
}

// Nodes of points and lines that no hexahedron has would hang loose.
void drop_unused(TipSolid& tip) {
  std::vector<int> place(tip.nodes.size(), -1);
  std::vector<Vec3> kept;
  const auto of = [&](int n) {
    int& at = place[static_cast<std::size_t>(n)];
    if (at < 0) {
      at = static_cast<int>(kept.size());
      kept.push_back(tip.nodes[static_cast<std::size_t>(n)]);
    }
    return at;
  };
  for (auto& h : tip.hexahedra)
    for (auto& n : h) n = of(n);
  for (int& n : tip.foot) n = of(n);
  for (auto& face : tip.end_faces)
    for (int& n : face) n = of(n);
  tip.nodes = std::move(kept);
}

TipSolid tip_of(const std::filesystem::path& file, double unit) {
  const GmshMesh mesh = read_gmsh(file);
  TipSolid tip;
  for (const auto& x : mesh.nodes) {
    tip.nodes.push_back(unit * x);
    if (tip.nodes.back().cwiseAbs().maxCoeff() > farthest)
      refuse(file, fmt::format("a node lies {:g} m away, allowed: up to {:g} m",
                               tip.nodes.back().cwiseAbs().maxCoeff(), farthest));
  }
  take_hexahedra(mesh, file, tip);
  take_surfaces(mesh, file, tip);
  drop_unused(tip);
  return tip;
}

}  // namespace

void load_meshed_tip(Scene& scene, const schema::Origins& origins, Problems& problems) {
  TipSpec& tip = scene.afm->tip;
  if (tip.shape != TipSpec::Shape::mesh) return;
  try {
    auto solid = std::make_shared<TipSolid>(tip_of(scene.file.parent_path() / tip.file, tip.unit));
    tip.height = solid->height;
    tip.foot = 2 * solid->reach;
    tip.solid = std::move(solid);
  } catch (const SceneError& error) {
    const auto found = origins.find("tip.file");
    problems.add(found == origins.end() ? document::Origin{{1, 1}, -1} : found->second, "tip.file",
                 error.errors().front().text());
  }
}

}  // namespace pulvis
