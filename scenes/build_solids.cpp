#include "scenes/build_solids.hpp"

#include "scenes/body_columns.hpp"
#include "scenes/checks/overlaps.hpp"
#include "scenes/checks/travel.hpp"
#include "scenes/needs.hpp"
#include "scenes/packing/place.hpp"
#include "scenes/results/solids/observe.hpp"
#include "scenes/solid_contact_columns.hpp"
#include "scenes/solid_layout.hpp"
#include "scenes/tools/cell.hpp"
#include "scenes/tools/constraints.hpp"
#include "scenes/tools/drives.hpp"

namespace pulvis::space {
namespace {

// m, undeformed.
NodePlaces node_places(const Shapes& shapes, const Bodies& bodies, const Layout& layout) {
  return [&](int slot) {
    const Placed& placed = *entry(layout.placed, slot);
    std::vector<Vec3> places;
    for (const Point& p : entry(shapes.list, entry(bodies.slots, slot).shape).nodes)
      places.emplace_back(placed.body->position + placed.turn * Vec3(p[0], p[1], p[2]));
    return places;
  };
}

}  // namespace

std::unique_ptr<World> build_world(const Scene& scene, const Part& part) {
  const std::vector<BodySpec> bodies = place_bodies(scene);
  check_overlaps(scene, bodies);
  check_travel(scene, bodies);
  Layout layout = lay_out(scene, bodies);
  std::unique_ptr<World> world = empty_world(part);
  hold_part(*world, part, layout.bodies, centres(layout), elements_of_chunks(layout));
  const Needs needs = needs_of(scene, bodies.size());
  add_body_columns(*world, layout, needs);
  fill_bodies(*world, layout);
  fill_materials(*world, scene, layout.bodies);
  add_flow_laws(*world, scene, needs);
  add_run_state(*world, scene);
  world->emplace<Bodies>(std::move(layout.bodies));
  world->emplace<Shapes>(std::move(layout.shapes));
  world->emplace<ParticleClasses>(std::move(layout.classes));
  if (!scene.tools.empty()) {
    add_tool_columns(*world, scene, needs.tools);
    add_drives<ThreeD>(*world, scene, bodies);
  }
  add_contact(*world, scene, needs);
  add_cell<ThreeD>(*world, scene, bodies);
  if (scene.cell) add_drives<ThreeD>(*world, scene, bodies);
  if (needs.constraints)
    add_constraints<ThreeD>(
        *world, scene, node_places(world->resource<Shapes>(), world->resource<Bodies>(), layout));
  space::add_observed(*world, scene);
  return world;
}

}  // namespace pulvis::space
