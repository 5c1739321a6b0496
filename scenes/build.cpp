#include "scenes/build.hpp"
#include "scenes/body_columns.hpp"
#include "scenes/checks/overlaps.hpp"
#include "scenes/checks/travel.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "components/bond.hpp"
#include "components/contact.hpp"
#include "components/observed.hpp"
#include "components/particle_classes.hpp"
#include "components/run_state.hpp"
#include "components/servo.hpp"
#include "components/surface.hpp"
#include "engine/access.hpp"
#include "scenes/build_solids.hpp"
#include "scenes/contact_search.hpp"
#include "scenes/grains/grains.hpp"
#include "scenes/highest_mode.hpp"
#include "scenes/layout.hpp"
#include "scenes/meshes/hollows.hpp"
#include "scenes/meshes/thinnest.hpp"
#include "scenes/needs.hpp"
#include "scenes/packing/place.hpp"
#include "scenes/ranks/share.hpp"
#include "scenes/results/observe.hpp"
#include "scenes/tools/bond_rules.hpp"
#include "scenes/tools/cell.hpp"
#include "scenes/tools/constraints.hpp"
#include "scenes/tools/contact_rules.hpp"
#include "scenes/tools/drives.hpp"
#include "scenes/tools/surface.hpp"

namespace pulvis {

namespace {

template <class At>
void add_row_columns(World& world, const Needs& needs) {
  world.add_table<At>(std::size_t{0});
  world.add<ContactPair<At>>();
  world.add<ContactTouches<At>>();
  world.add<ReactivationDistance<At>>();
  world.add<ContactLaw<At>>();
  world.add<PointForce<At>>();
  if (needs.indentation) world.add<PointIndentation<At>>();
  if (needs.friction) world.add<ElasticSlip<At>>();
  if (needs.weakening) world.add<SlipWeakening<At>>();
  if (needs.weakening || needs.adhesion) world.add<SurfaceLawNumber<At>>();
  world.emplace<RowBlocks<At>>();
  world.emplace<ContactSums<At>>();
}

template <class At>
void add_bond_columns(World& world, bool welds) {
  world.add<BondLawNumber<At>>();
  world.add<BondedPoints<At>>();
  world.add<BondOffset<At>>();
  world.add<BondStrength<At>>();
  world.add<BondDamage<At>>();
  if (welds) world.add<WeldPressure<At>>();
  world.emplace<BondSums<At>>();
}

// m, of the outlines.
double longest_edge(const Bodies& bodies) {
  double longest = 0;
  for (const Shape& shape : bodies.shapes)
    for (const Shape::Edge& edge : shape.edges) longest = std::max(longest, edge.length);
  return longest;
}

void add_bonds(World& world, const Needs& needs) {
  if (needs.bonds()) {
    add_bond_columns<Contact>(world, needs.welds);
    world.add<CurveAnchor>();
  }
  if (needs.tool_bonds()) {
    add_bond_columns<ToolContact>(world, needs.tool_welds);
    world.add<ToolAnchor>();
  }
}

void add_contact_columns(World& world, const Bodies& bodies, const Needs& needs) {
  const auto rows_by_chunk = [&](const auto& count) {
    std::vector<std::int32_t> rows;
    for (int c = 0; c < bodies.chunks(); ++c)
      rows.push_back(count(bodies.shape_of_chunk(Chunk{c})));
    return rows;
  };
  world.add_table<BoundaryNode>(rows_by_chunk([](const Shape& s) { return s.boundary_nodes; }));
  world.add_table<ControlPoint>(
      rows_by_chunk([](const Shape& s) { return lane_count * s.control_points(); }));
  world.add<ContactForce<TwoD>>();
  world.add<CurvePosition>();
  world.add<CurveBefore>();
  world.add<CurveForce>();
  world.add<MaximumSpeed>();
  if (needs.friction || needs.damping) world.add<CurveVelocity>();
  if (needs.indentation) world.add<SurfaceHardness<TwoD>>();
  if (needs.pairs) {
    add_row_columns<Contact>(world, needs);
    world.add<ContactPlace>();
    world.add<ClosestPoint>();
    if (needs.friction || needs.bonds()) world.add<SlopeLoad>();
  }
  if (needs.tools) add_row_columns<ToolContact>(world, needs);
  if (needs.polylines) world.add<SurfaceRange>();
}

NodePlaces undeformed_nodes(const World& world, const Layout& layout) {
  return [&](int slot) {
    std::vector<Vec3> places;
    for (const Vec2& node :
         placed_nodes(world.resource<Bodies>().shape_of_slot(slot), *entry(layout.placed, slot)))
      places.push_back(in_space(node));
    return places;
  };
}

ToolShapes tool_shapes(const Scene& scene) {
  ToolShapes shapes;
  for (const ToolSpec& tool : scene.tools) {
    const bool polyline = tool.shape == ToolSpec::Shape::polyline;
    shapes.kind.push_back(polyline              ? ToolShapes::Kind::polyline
                          : is_constraint(tool) ? ToolShapes::Kind::constraint
                                                : ToolShapes::Kind::plane);
    shapes.surface.push_back(polyline ? make_surface(tool.points, tool.rounding) : ToolSurface{});
  }
  return shapes;
}

void add_tools(World& world, const Scene& scene, const std::vector<BodySpec>& bodies,
               const Needs& needs) {
  add_tool_columns(world, scene, needs.tools);
  if (needs.polylines || needs.constraints) world.emplace<ToolShapes>(tool_shapes(scene));
  add_drives<TwoD>(world, scene, bodies);
}

double shortest_edge(const Bodies& bodies) {
  double minimum = std::numeric_limits<double>::max();
  for (const Shape& shape : bodies.shapes)
    for (const Shape::Edge& edge : shape.edges) minimum = std::min(minimum, edge.length);
  return minimum;
}

// What surfaces could pass through: elements, and tool ridges that are thinner than those.
void find_thinnest(const Scene& scene, const Bodies& bodies, ContactRules& rules) {
  rules.shortest_edge = shortest_edge(bodies);
  rules.thinnest = rules.shortest_edge;
  for (const Shape& shape : bodies.shapes)
    rules.thinnest = std::min(rules.thinnest, thinnest_part(shape));
  const double maximum = rules.shortest_edge;
  for (const ToolSpec& tool : scene.tools) {
    rules.tool_thickness.push_back(
        tool.shape == ToolSpec::Shape::polyline
            ? thinnest_part(drawn_points(make_surface(tool.points, tool.rounding)), maximum,
                            maximum)
            : std::numeric_limits<double>::infinity());
    rules.thinnest = std::min(rules.thinnest, rules.tool_thickness.back());
  }
}

void add_hollows(World& world, const Bodies& bodies) {
  Hollows hollows;
  for (const Shape& shape : bodies.shapes) hollows.of_shape.push_back(hollows_of(shape));
  if (!std::ranges::all_of(hollows.of_shape, [](const auto& loops) { return loops.empty(); }))
    world.emplace<Hollows>(std::move(hollows));
}

std::unique_ptr<World> build_in_space(const Scene& scene, const Part& part) {
  std::unique_ptr<World> world = space::build_world(scene, part);
  if (scene.time.estimate == TimeSpec::Estimate::highest_mode)
    add_highest_mode(*world, world->resource<Bodies>(), world->resource<space::Shapes>(),
                     world->has<ContactRules>());
  return world;
}

std::unique_ptr<World> build_part(const Scene& scene, const Part& part) {
  if (scene.in_space()) return build_in_space(scene, part);
  const std::vector<BodySpec> particles = place_bodies(scene);
  check_overlaps(scene, particles);
  check_travel(scene, particles);
  const std::vector<BodySpec> bodies = grains_of(scene, particles);
  const Needs needs = needs_of(scene, bodies.size());
  const auto classes = placed_by_class(scene, bodies);
  Layout layout = lay_out(scene, classes, bodies.size());

  std::unique_ptr<World> world = empty_world(part);
  hold_part(*world, part, layout.bodies, centres(layout), elements_of_chunks(layout));
  add_body_columns(*world, layout, needs);
  if (needs.tools || needs.constraints) add_tools(*world, scene, particles, needs);
  if (needs.contact()) {
    add_contact_columns(*world, layout.bodies, needs);
    add_cell<TwoD>(*world, scene, particles);
    if (scene.cell) add_drives<TwoD>(*world, scene, particles);
    world->emplace<ContactQuality>();
    ContactRules& rules = world->emplace<ContactRules>(contact_rules(scene));
    if (needs.inerters) add_inerters(*world, rules);
    find_thinnest(scene, layout.bodies, rules);
    rules.servos = world->has<ServoVelocity>();
    ContactIndex& index = world->emplace<ContactIndex>();
    double bonds_reach = 0;
    if (needs.any_bonds()) {
      add_bonds(*world, needs);
      const BondRules& bonds = world->emplace<BondRules>(
          bounded_by(layout.bodies, surface_springs(layout.bodies), scene, bond_rules(scene)));
      set_stiffest_bonds(bonds, rules);
      bonds_reach = longest_gap(longest_edge(layout.bodies), bonds);
    }
    set_reach(index, scene, rules, bonds_reach);
  }
  if (needs.contact() || needs.constraints) add_hollows(*world, layout.bodies);
  fill_bodies(*world, layout);
  if (scene.time.estimate == TimeSpec::Estimate::highest_mode)
    add_highest_mode(*world, layout.bodies, needs.contact());
  fill_materials(*world, scene, layout.bodies);
  add_flow_laws(*world, scene, needs);
  add_run_state(*world, scene);
  add_bond_totals(*world, scene);
  world->emplace<Bodies>(std::move(layout.bodies));
  world->emplace<ParticleClasses>(std::move(layout.classes));
  if (needs.constraints) add_constraints<TwoD>(*world, scene, undeformed_nodes(*world, layout));
  add_observed(*world, scene);
  return world;
}

}  // namespace

std::unique_ptr<World> build_world(const Scene& scene, Ranks* ranks) {
  return build_part(scene, Part{ranks});
}

std::unique_ptr<World> build_whole_world(const Scene& scene) {
  std::unique_ptr<World> world = build_part(scene, Part{nullptr, true});
  world->resource<Bodies>().hold_all();
  return world;
}

}  // namespace pulvis
