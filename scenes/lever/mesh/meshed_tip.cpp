#include "scenes/lever/mesh/meshed_tip.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "scenes/spec/scene.hpp"

namespace pulvis {
namespace {

constexpr const char* file_key = "tip.file";

TipSolid tip_of(const std::filesystem::path& file, double unit) {
  TipSolid tip;
  tip.solid = read_gmsh_solid(file, unit,
                              {file_key,
                               {{"tip", SolidPart::tip}, {"glue", SolidPart::glue}},
                               {{"foot", false}, {"end", false}}});
  if (!tip.solid.has(SolidPart::tip))
    refuse_mesh(file, 1, file_key,
                "has no elements in a volume named tip, allowed: a physical volume \"tip\"");
  const std::set<int> foot = tip.solid.nodes_of("foot");
  if (foot.empty() || tip.solid.surfaces["end"].empty())
    refuse_mesh(file, 1, file_key,
                "a surface is missing, allowed: physical surfaces \"foot\" and \"end\"");
  tip.foot.assign(foot.begin(), foot.end());
  tip.end = tip.solid.surfaces["end"];
  const auto at = [&](int n) { return tip.solid.nodes[static_cast<std::size_t>(n)]; };
  for (const int n : tip.solid.nodes_of("end")) tip.height = std::max(tip.height, -at(n).z());
  if (!(tip.height > 0))
    refuse_mesh(file, 1, file_key, "the end does not lie below z = 0, allowed: z < 0");
  for (const int n : tip.foot) {
    tip.reach = std::max(tip.reach, at(n).head<2>().cwiseAbs().maxCoeff());
    if (std::abs(at(n).z()) > 1e-6 * tip.height)
      refuse_mesh(
          file, 1, file_key,
          fmt::format("the foot is at z = {:g} m, allowed: in z = 0, the end below it", at(n).z()));
  }
  return tip;
}

}  // namespace

void load_meshed_tip(Scene& scene, const schema::Origins& origins, Problems& problems) {
  TipSpec& tip = scene.afm->tip;
  if (tip.shape != TipSpec::Shape::mesh || tip.file.empty()) return;
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
