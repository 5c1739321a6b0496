#include "scenes/lever/mesh/lever_mesh.hpp"

#include <algorithm>
#include <cmath>

#include "engine/portable_math.hpp"
#include "scenes/lever/mesh/grading.hpp"

namespace pulvis {
namespace {

constexpr double growth_above_foot = 1.2;

// The interfaces between the layers, from the lower face up.
struct Levels {
  std::vector<double> z;   // m
  std::vector<bool> main;  // over the whole lever; the others exist around the foot only
  int own = 0;             // number of layers without the coating
};

// From the lower face up.
std::vector<double> lines_at_foot(const LeverSpec& lever, double foot_edge) {
  const double t = lever.thickness;
  if (lever.foot_layers)
    return graded_lines(
        {t, t, t, t},
        std::max(1, static_cast<int>(std::round(*lever.foot_layers / lever.coarser))));
  return graded_lines({t, foot_edge, t, 0.5 * t, growth_above_foot, lever.coarser});
}

// Around the foot each layer is subdivided as often as graded lines lie inside it.
Levels levels_of(const LeverSpec& lever, bool solid_foot, double foot_edge) {
  const double t = lever.thickness;
  Levels levels;
  const auto add = [&](double z, bool main) {
    levels.z.push_back(z);
    levels.main.push_back(main);
  };
  const std::vector<double> fine = solid_foot ? lines_at_foot(lever, foot_edge) : std::vector{0.0};
  for (int i = 0; i < lever.layers; ++i) {
    const double lower = t * i / lever.layers, upper = t * (i + 1) / lever.layers;
    add(lower - 0.5 * t, true);
    if (lever.layers == 1) {
      for (std::size_t l = 1; l + 1 < fine.size(); ++l) add(fine[l] - 0.5 * t, false);
      continue;
    }
    const auto within = std::ranges::count_if(
        fine, [&](double z) { return z > lower * (1 + 1e-9) && z < upper * (1 - 1e-9); });
    for (int l = 1; l <= within; ++l)
      add(lower + (upper - lower) * l / static_cast<double>(within + 1) - 0.5 * t, false);
  }
  add(0.5 * t, true);
  levels.own = static_cast<int>(levels.z.size()) - 1;
  if (lever.coating) add(0.5 * t + lever.coating_thickness, true);
  return levels;
}

// Which points belong to quads of each kind.
struct Kinds {
  std::vector<bool> solid, plate;
  explicit Kinds(const LeverPlan& plan)
      : solid(plan.mesh.points.size()), plate(plan.mesh.points.size()) {
    for (std::size_t q = 0; q < plan.mesh.quads.size(); ++q)
      for (const int p : plan.mesh.quads[q])
        (plan.solid[q] ? solid : plate)[static_cast<std::size_t>(p)] = true;
  }
};

}  // namespace

std::optional<LeverMesh::Point> LeverMesh::on(std::size_t level, const Vec2& point) const {
  const LeverLevel& at = levels[level];
  const auto place = locate(*at.plan, point);
  if (!place) return {};
  Point found;
  for (const auto& [p, weight] : *place) {
    const int node = at.node[static_cast<std::size_t>(p)];
    if (node < 0) return {};
    found.gauge.push_back({node, weight});
    found.z += weight * at.z[static_cast<std::size_t>(p)];
  }
  return found;
}

std::optional<LeverMesh::Point> LeverMesh::on_middle(const Vec2& point) const {
  std::optional<Point> below = on(0, point), above;
  for (std::size_t level = 1; level < levels.size(); ++level) {
    auto next = on(level, point);
    if (!next) continue;
    if (above && above->z < 0) below = std::move(above);
    above = std::move(next);
    if (above->z >= 0) break;
  }
  if (!below || !above) return {};
  const double s = -below->z / (above->z - below->z);
  Point middle;
  for (const auto& [node, weight] : below->gauge) middle.gauge.push_back({node, (1 - s) * weight});
  for (const auto& [node, weight] : above->gauge) middle.gauge.push_back({node, s * weight});
  return middle;
}

namespace {

// Nodes of all levels; next to plates, the nodes of solid elements are tied to the plates' faces.
LeverMesh add_levels(SolidDraft& draft, const LeverSpec& lever, const LeverPlan& plan,
                     const Levels& levels) {
  LeverMesh mesh;
  const auto shared = std::make_shared<const PlanMesh>(plan.mesh);
  const Kinds kinds(plan);
  const std::size_t points = plan.mesh.points.size();
  for (std::size_t l = 0; l < levels.z.size(); ++l) {
    LeverLevel level{shared, std::vector<int>(points, -1),
                     std::vector<double>(points, levels.z[l])};
    for (std::size_t p = 0; p < points; ++p) {
      if (!levels.main[l] && !kinds.solid[p]) continue;
      const Vec2& at = plan.mesh.points[p];
      level.node[p] = draft.add_node({at.x(), at.y(), levels.z[l]});
      draft.held[static_cast<std::size_t>(level.node[p])] =
          std::abs(at.x()) < 1e-9 * lever.length ? 1 : 0;
    }
    mesh.levels.push_back(std::move(level));
  }
  for (std::size_t l = 0; l < levels.z.size(); ++l) {
    if (levels.main[l]) continue;
    std::size_t below = l, above = l;
    while (!levels.main[below]) --below;
    while (!levels.main[above]) ++above;
    const double s = (levels.z[l] - levels.z[below]) / (levels.z[above] - levels.z[below]);
    for (std::size_t p = 0; p < points; ++p)
      if (kinds.solid[p] && kinds.plate[p])
        draft.hang(mesh.levels[l].node[p],
                   {{mesh.levels[below].node[p], 1 - s}, {mesh.levels[above].node[p], s}});
  }
  return mesh;
}

}  // namespace

int foot_layers(const LeverSpec& lever, double foot_edge) {
  return levels_of(lever, true, foot_edge).own;
}

LeverMesh add_lever(SolidDraft& draft, const LeverSpec& lever, const LeverPlan& plan,
                    double foot_edge) {
  const bool solid_foot = std::ranges::find(plan.solid, true) != plan.solid.end();
  const Levels levels = levels_of(lever, solid_foot, foot_edge);
  LeverMesh mesh = add_levels(draft, lever, plan, levels);
  const auto own = static_cast<std::size_t>(levels.own);
  for (std::size_t q = 0; q < plan.mesh.quads.size(); ++q) {
    const bool solid = plan.solid[q];
    const bool plate = !solid || lever.element != HexFormulation::plate;
    for (std::size_t lower = 0; lower + 1 < levels.z.size();) {
      std::size_t upper = lower + 1;
      while (!solid && !levels.main[upper]) ++upper;
      SolidMesh::Hexahedron corners;
      for (std::size_t c = 0; c < 4; ++c) {
        const auto p = static_cast<std::size_t>(plan.mesh.quads[q][c]);
        corners[c] = mesh.levels[lower].node[p];
        corners[c + 4] = mesh.levels[upper].node[p];
      }
      draft.add_hexahedron(corners, lower >= own ? SolidPart::coating : SolidPart::lever,
                           plate ? lever.element : HexFormulation::solid);
      lower = upper;
    }
  }
  return mesh;
}

}  // namespace pulvis
