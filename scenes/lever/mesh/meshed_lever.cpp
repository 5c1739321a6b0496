#include "scenes/lever/mesh/meshed_lever.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>

#include "scenes/spec/scene.hpp"

namespace pulvis {
namespace {

constexpr const char* key = "lever.file";

class LeverReader {
 public:
  LeverReader(const std::filesystem::path& file, double unit) : file_(file) {
    lever_.solid =
        read_gmsh_solid(file, unit,
                        {key,
                         {{"lever", SolidPart::lever},
                          {"coating", SolidPart::coating},
                          {"tip", SolidPart::tip},
                          {"glue", SolidPart::glue}},
                         {{"clamp", false}, {"face", true}, {"back", false}, {"end", false}}});
  }

  LeverSolid read() {
    if (!solid().has(SolidPart::lever))
      refuse("has no elements in a volume named lever, allowed: a physical volume \"lever\"");
    for (const char* name : {"clamp", "face", "back"})
      if (!solid().surfaces.contains(name))
        refuse(
            fmt::format("the surface '{}' is missing, allowed: physical surfaces \"clamp\", "
                        "\"face\" (towards the sample) and \"back\" (the laser's side)",
                        name));
    dimensions();
    hangs_together();
    for (auto& hexahedron : lever_.solid.hexahedra) lay_flat(hexahedron);
    lever_.face = side("face");
    lever_.back = side("back");
    tip();
    return std::move(lever_);
  }

 private:
  [[noreturn]] void refuse(const std::string& message) const {
    refuse_mesh(file_, 1, key, message);
  }
  const GmshSolid& solid() const { return lever_.solid; }
  Vec3 at(int n) const { return solid().nodes[static_cast<std::size_t>(n)]; }

  template <class Each>
  void for_elements(const Each& each) const {
    for (std::size_t e = 0; e < solid().hexahedra.size(); ++e)
      each(solid().hexahedra[e], solid().hexahedron_part[e]);
    for (std::size_t e = 0; e < solid().tetrahedra.size(); ++e)
      each(solid().tetrahedra[e], solid().tetrahedron_part[e]);
  }

  void dimensions() {
    Eigen::AlignedBox3d box;
    for_elements([&](const auto& nodes, SolidPart part) {
      for (const int n : nodes)
        if (part == SolidPart::lever) box.extend(at(n));
    });
    lever_.length = box.max().x();
    lever_.thickness = box.sizes().z();
    double nearest = box.max().x();
    for (const int n : solid().nodes_of("clamp")) nearest = std::min(nearest, std::abs(at(n).x()));
    if (!(lever_.length > 0) || nearest > 1e-3 * lever_.length)
      refuse(
          fmt::format("the clamp lies {:g} m from x = 0 and the lever ends at x = {:g} m, "
                      "allowed: the clamp at x = 0, the lever along +x",
                      nearest, lever_.length));
    if (std::abs(box.center().z()) > 1e-3 * lever_.thickness)
      refuse(
          fmt::format("the lever reaches from z = {:g} to {:g} m, allowed: its middle in z = 0, "
                      "z away from the sample",
                      box.min().z(), box.max().z()));
  }

  // Volumes that share no nodes with the clamped ones would be unconstrained.
  void hangs_together() const {
    std::vector<int> root(solid().nodes.size());
    std::iota(root.begin(), root.end(), 0);
    const auto find = [&](int n) {
      while (root[static_cast<std::size_t>(n)] != n)
        n = root[static_cast<std::size_t>(n)] =
            root[static_cast<std::size_t>(root[static_cast<std::size_t>(n)])];
      return n;
    };
    for_elements([&](const auto& nodes, SolidPart) {
      for (const int n : nodes) root[static_cast<std::size_t>(find(n))] = find(nodes[0]);
    });
    const int held = find(*solid().nodes_of("clamp").begin());
    for (std::size_t n = 0; n < root.size(); ++n)
      if (find(static_cast<int>(n)) != held)
        refuse(fmt::format(
            "the elements at x = {:g}, y = {:g}, z = {:g} m are not connected to the clamped ones, "
            "allowed: volumes with conforming meshes (BooleanFragments, Coherence)",
            solid().nodes[n].x(), solid().nodes[n].y(), solid().nodes[n].z()));
  }

  // Plates are thin along their third direction: the one nearest to z.
  void lay_flat(SolidMesh::Hexahedron& h) const {
    static constexpr std::array<std::array<std::size_t, 8>, 3> turned{
        {{0, 4, 7, 3, 1, 5, 6, 2}, {0, 1, 5, 4, 3, 2, 6, 7}, {0, 1, 2, 3, 4, 5, 6, 7}}};
    static constexpr std::array<std::size_t, 3> next{1, 3, 4};
    std::size_t best = 0;
    double maximum = -1;
    for (std::size_t k = 0; k < 3; ++k) {
      const double upright = std::abs((at(h[next[k]]) - at(h[0])).normalized().z());
      if (upright > maximum) maximum = upright, best = k;
    }
    SolidMesh::Hexahedron flat;
    for (std::size_t c = 0; c < 8; ++c) flat[c] = h[turned[best][c]];
    turn_outside_out(solid().nodes, flat);
    h = flat;
  }

  LeverSide side(const std::string& name) const {
    LeverSide side;
    std::map<int, int> point;
    for (const int n : solid().nodes_of(name)) {
      point[n] = static_cast<int>(side.node.size());
      side.node.push_back(n);
      side.z.push_back(at(n).z());
      side.plan.points.push_back(at(n).head<2>());
    }
    for (const auto& facet : solid().surfaces.at(name)) add_facet(facet, name, point, side.plan);
    return side;
  }

  void add_facet(const std::vector<int>& facet, const std::string& name,
                 const std::map<int, int>& point, PlanMesh& plan) const {
    const bool triangle = facet.size() == 6;
    const Vec3 across =
        triangle ? Vec3((at(facet[1]) - at(facet[0])).cross(at(facet[2]) - at(facet[0])))
                 : Vec3((at(facet[2]) - at(facet[0])).cross(at(facet[3]) - at(facet[1])));
    if (std::abs(across.z()) < 0.1 * across.norm())
      refuse(
          fmt::format("the surface '{}' is vertical at x = {:g}, y = {:g} m, allowed: a surface "
                      "visible along z",
                      name, at(facet[0]).x(), at(facet[0]).y()));
    std::vector<int> p;
    for (const int n : facet) p.push_back(point.at(n));
    const bool back = across.z() < 0;
    if (triangle && back) p = {p[0], p[2], p[1], p[5], p[4], p[3]};
    if (!triangle && back) std::swap(p[1], p[3]);
    if (triangle)
      plan.triangles.push_back({p[0], p[1], p[2], p[3], p[4], p[5]});
    else
      plan.quads.push_back({p[0], p[1], p[2], p[3]});
  }

  void tip() {
    const bool stands = solid().has(SolidPart::tip);
    if (stands != solid().surfaces.contains("end"))
      refuse(
          "has a tip without an end or an end without a tip, allowed: a physical volume \"tip\" "
          "with a physical surface \"end\", or neither");
    if (!stands) return;
    lever_.end = solid().surfaces.at("end");
    const std::set<int> nodes = solid().nodes_of("end");
    double lowest = 0;
    for (const int n : nodes) {
      lever_.tip_axis += at(n).head<2>() / static_cast<double>(nodes.size());
      lowest = std::min(lowest, at(n).z());
    }
    lever_.tip_height = -lowest - 0.5 * lever_.thickness;
    if (!(lever_.tip_height > 0))
      refuse("the tip's end does not lie below the lever, allowed: z towards the sample is < 0");
    if (!locate(lever_.face.plan, lever_.tip_axis))
      refuse(
          fmt::format("no element of 'face' lies above the tip's end (x = {:g}, y = {:g} m), "
                      "allowed: a 'face' that includes the area under the tip",
                      lever_.tip_axis.x(), lever_.tip_axis.y()));
  }

  std::filesystem::path file_;
  LeverSolid lever_;
};

}  // namespace

void load_meshed_lever(Scene& scene, const schema::Origins& origins, Problems& problems) {
  LeverSpec& lever = scene.afm->lever;
  TipSpec& tip = scene.afm->tip;
  if (lever.shape != LeverSpec::Shape::mesh) return;
  const auto refuse = [&](const std::string& path, const std::string& message) {
    const auto found = origins.find(path);
    problems.add(found == origins.end() ? document::Origin{{1, 1}, -1} : found->second, path,
                 message);
  };
  try {
    const LeverSolid solid = LeverReader(scene.file.parent_path() / lever.file, lever.unit).read();
    lever.length = solid.length;
    lever.thickness = solid.thickness;
    if (solid.solid.has(SolidPart::coating) != lever.coating.has_value())
      refuse("lever.coating", lever.coating ? "the file has no volume named coating, allowed: one, "
                                              "or no lever.coating"
                                            : "required key is missing, allowed: the material of "
                                              "the file's volume 'coating'");
    for (const auto& [path, given] :
         {std::pair{"tip.set_back", tip.set_back}, {"tip.offset", tip.offset}})
      if (!solid.end.empty() && given != 0)
        refuse(path, "the lever's file defines the position of its tip, allowed: not given");
    const bool own_tip = tip.shape == TipSpec::Shape::mesh && tip.file.empty();
    if (own_tip && !solid.end.empty()) {
      tip.height = solid.tip_height;
      tip.set_back = solid.length - solid.tip_axis.x();
      tip.offset = solid.tip_axis.y();
    } else if (!own_tip && !solid.end.empty()) {
      refuse("tip.shape", "the lever's file contains a tip, allowed: \"mesh\" without a file");
    }
    lever.solid = std::make_shared<const LeverSolid>(std::move(solid));
  } catch (const SceneError& error) {
    refuse(key, error.errors().front().text());
  }
}

LeverMesh add_meshed_lever(SolidDraft& draft, const LeverSpec& lever) {
  const LeverSolid& from = *lever.solid;
  add_gmsh_solid(draft, from.solid, Vec3::Zero(), lever.element);
  for (const int n : from.solid.nodes_of("clamp")) draft.held[static_cast<std::size_t>(n)] = 1;
  LeverMesh mesh;
  for (const LeverSide* side : {&from.face, &from.back})
    mesh.levels.push_back({std::make_shared<const PlanMesh>(side->plan), side->node, side->z});
  return mesh;
}

}  // namespace pulvis
