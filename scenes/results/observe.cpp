#include "scenes/results/observe.hpp"

#include <algorithm>
#include <map>

#include "components/bond.hpp"
#include "components/observed.hpp"
#include "components/run_state.hpp"
#include "components/surface.hpp"
#include "scenes/results/solids/observe.hpp"
#include "scenes/tools/die_sides.hpp"
#include "scenes/tools/surface.hpp"

namespace pulvis {
namespace {

// Edges that belong to only one element: outline and holes, with the material on the left.
std::vector<DensityGrid::OutlineEdge> outline_of(const Shape& shape) {
  std::map<std::pair<int, int>, int> count;
  const auto key = [](Row<Node> a, Row<Node> b) {
    return std::pair<int, int>(std::minmax({a.value, b.value}));
  };
  for (const auto& quad : shape.quads)
    for (std::size_t k = 0; k < 4; ++k) ++count[key(quad[k], quad[(k + 1) % 4])];
  std::vector<DensityGrid::OutlineEdge> edges;
  for (const auto& quad : shape.quads)
    for (std::size_t k = 0; k < 4; ++k)
      if (count[key(quad[k], quad[(k + 1) % 4])] == 1)
        edges.push_back({quad[k], quad[(k + 1) % 4]});
  return edges;
}

DensityGrid density_grid(const Scene& scene, const Bodies& bodies) {
  DensityGrid grid;
  grid.columns = scene.output.density_cells[0];
  grid.rows = scene.output.density_cells[1];
  grid.tool = *die_sides(scene);
  for (std::size_t s = 0; s < 4; ++s) {
    const ToolSpec& tool = scene.tools[static_cast<std::size_t>(grid.tool[s])];
    if (tool.shape != ToolSpec::Shape::polyline) continue;
    for (const Vec2& p : drawn_points(make_surface(tool.points, tool.rounding)))
      grid.surface[s].push_back({p.x(), p.y()});
  }
  for (const Shape& shape : bodies.shapes) grid.outline.push_back(outline_of(shape));
  return grid;
}

}  // namespace

void check_output(const Scene& scene, const schema::Origins& origins, Problems& problems) {
  const auto refuse = [&](const std::string& key, const std::string& message) {
    problems.add(origins.at("output." + key), "output." + key, message);
  };
  const bool enclosed =
      scene.in_space() ? space::has_grid_room(scene) : die_sides(scene).has_value();
  if (scene.output.density() && !enclosed)
    refuse("density_cells",
           scene.in_space()
               ? "the tools do not enclose a space for the grid, allowed: with six planes whose "
                 "normals are along the axes, or a cylindrical die along one axis between two "
                 "planes or "
                 "punches"
               : "the tools do not enclose a grid, allowed: with one tool on each of the four "
                 "sides, planes with normals along an axis, or polylines");
  // In a periodic cell even a single particle can: its own images.
  const bool touchable = scene.cell || std::ranges::any_of(scene.tools, [](const ToolSpec& t) {
                           return t.shape != ToolSpec::Shape::constraint;
                         });
  if (scene.output.contacts && !touchable && scene.packings.empty() && scene.bodies.size() < 2)
    refuse("contacts",
           "has no effect: nothing can touch the only particle, allowed: with two particles, or "
           "with a tool that is not a constraint");
}

void add_observed(World& world, const Scene& scene) {
  if (world.has<BondTotals>()) world.emplace<Fragments>();
  if (scene.observes_stress()) {
    world.add<ParticleStress<TwoD>>();
    world.add<DeformedSize<TwoD>>();
    world.add<ParticleCentre<TwoD>>();
  }
  if (scene.output.contacts) {
    world.emplace<ContactNetwork<TwoD>>();
    world.emplace<ForceChains>();
  }
  if (scene.output.density())
    world.emplace<DensityGrid>(density_grid(scene, world.resource<Bodies>()));
}

}  // namespace pulvis
