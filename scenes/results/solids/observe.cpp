#include "scenes/results/solids/observe.hpp"

#include <algorithm>

#include "components/observed.hpp"
#include "components/space/contact.hpp"
#include "components/space/observed.hpp"
#include "engine/entry.hpp"
#include "scenes/spec/scene.hpp"
#include "scenes/tools/die_room.hpp"

namespace pulvis::space {
namespace {

DensityGrid::Profile profile_of(const ToolSpec& tool) {
  DensityGrid::Profile profile;
  if (tool.shape == ToolSpec::Shape::punch)
    for (const Vec2& p : tool.profile) profile.push_back({p.x(), p.y()});
  return profile;
}

DensityGrid density_grid(const Scene& scene) {
  DensityGrid grid;
  grid.cells = scene.output.density_cells3;
  grid.between = *die_room(scene);
  if (grid.between.kind == DieRoom::Kind::round)
    for (const auto& [end, side] : {std::pair{0, DieRoom::bottom}, {1, DieRoom::top}})
      entry(grid.bottom_top, end) = profile_of(entry(scene.tools, grid.between.tool[side]));
  return grid;
}

}  // namespace

bool has_grid_room(const Scene& scene) {
  const auto room = die_room(scene);
  return room && std::ranges::count(room->axis, 0.0) == 2;
}

void add_observed(World& world, const Scene& scene) {
  if (scene.observes_stress()) {
    world.add<ParticleStress<ThreeD>>();
    world.add<DeformedSize<ThreeD>>();
    world.add<ParticleCentre<ThreeD>>();
  }
  if (scene.output.contacts) {
    world.emplace<ContactNetwork<ThreeD>>();
    world.emplace<ForceChains>();
    if (world.has<ContactPoint>()) world.add<ContactPointForce>();
  }
  if (scene.output.density()) world.emplace<DensityGrid>(density_grid(scene));
}

}  // namespace pulvis::space
