#include "scenes/space/build.hpp"

#include <algorithm>
#include <array>

#include "components/run_state.hpp"
#include "scenes/checks/travel.hpp"
#include "scenes/packing/place.hpp"
#include "scenes/space/contact_columns.hpp"
#include "scenes/space/layout.hpp"
#include "scenes/space/overlaps.hpp"
#include "scenes/space/results/observe.hpp"
#include "scenes/space/tools/drives.hpp"
#include "scenes/tools/constraints.hpp"
#include "systems/laws/flow_law.hpp"

namespace pulvis::space {
namespace {

// For materials without one: linear hardening, whose constants are in columns.
void add_flow_laws(World& world, const Scene& scene) {
  if (std::ranges::none_of(scene.materials, [](const MaterialSpec& m) { return bool(m.flow); }))
    return;
  FlowLaws laws;
  for (const MaterialSpec& m : scene.materials)
    laws.of_material.push_back(m.flow ? *m.flow : FlowLaw{});
  world.emplace<FlowLaws>(std::move(laws));
}

void add_run_state(World& world, const Scene& scene) {
  Clock& clock = world.emplace<Clock>();
  clock.safety = scene.time.safety;
  for (const StageSpec& stage : scene.stages) clock.end += stage.duration;
  world.emplace<Totals>();
}

// m, of every occupied slot.
std::vector<std::array<double, 3>> centres(const Layout& layout) {
  std::vector<std::array<double, 3>> all(layout.placed.size());
  for (std::size_t slot = 0; slot < all.size(); ++slot)
    if (const auto& placed = layout.placed[slot])
      all[slot] = {placed->body->position.x(), placed->body->position.y(),
                   placed->body->position.z()};
  return all;
}

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

std::vector<double> elements_of_chunks(const Layout& layout) {
  std::vector<double> all;
  for (int chunk = 0; chunk < layout.bodies.chunks(); ++chunk) {
    const int shape = entry(layout.bodies.slots, chunk * lane_count).shape;
    all.push_back(static_cast<double>(entry(layout.shapes.list, shape).elements()));
  }
  return all;
}

}  // namespace

std::unique_ptr<World> build_world(const Scene& scene, const Part& part) {
  const std::vector<BodySpec> bodies = place_bodies(scene);
  space::check_overlaps(scene, bodies);
  check_travel(scene, bodies);
  Layout layout = lay_out(scene, bodies);
  std::unique_ptr<World> world = empty_world(part);
  hold_part(*world, part, layout.bodies, centres(layout), elements_of_chunks(layout));
  add_body_columns(*world, scene, layout.bodies, layout.shapes);
  fill_bodies(*world, layout.placed, layout.bodies, layout.shapes);
  fill_materials(*world, scene, layout.bodies);
  add_flow_laws(*world, scene);
  add_run_state(*world, scene);
  world->emplace<Bodies>(std::move(layout.bodies));
  world->emplace<Shapes>(std::move(layout.shapes));
  world->emplace<ParticleClasses>(std::move(layout.classes));
  add_tools(*world, scene, bodies);
  add_contact(*world, scene, bodies);
  if (std::ranges::any_of(scene.tools, is_constraint))
    add_constraints<ThreeD>(
        *world, scene, node_places(world->resource<Shapes>(), world->resource<Bodies>(), layout));
  add_observed(*world, scene);
  return world;
}

}  // namespace pulvis::space
