#include "scenes/build.hpp"
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
#include "scenes/grains/grains.hpp"
#include "scenes/highest_mode.hpp"
#include "scenes/layout.hpp"
#include "scenes/meshes/hollows.hpp"
#include "scenes/meshes/thinnest.hpp"
#include "scenes/needs.hpp"
#include "scenes/packing/place.hpp"
#include "scenes/ranks/share.hpp"
#include "scenes/results/observe.hpp"
#include "scenes/space/build.hpp"
#include "scenes/tools/bond_rules.hpp"
#include "scenes/tools/cell.hpp"
#include "scenes/tools/constraints.hpp"
#include "scenes/tools/contact_rules.hpp"
#include "scenes/tools/drives.hpp"
#include "scenes/tools/surface.hpp"
#include "systems/laws/flow_law.hpp"

namespace pulvis {

namespace {

// Surfaces must move by this many skins relative to each other before non-neighbours can come close:
// more than neighbours move, and few enough to keep lists short.
constexpr double skins_of_neighbourhood = 8;

template <class Count>
std::vector<std::int32_t> rows_by_chunk(const Bodies& bodies, const Count& count) {
  std::vector<std::int32_t> rows;
  for (int c = 0; c < bodies.chunks(); ++c)
    rows.push_back(static_cast<std::int32_t>(count(bodies.shape_of_chunk(Chunk{c}))));
  return rows;
}

template <class F>
void add_element_columns(World& world, const Needs& needs) {
  world.add<DeviatoricStress<TwoD, F::points>>();
  world.add<MeanStress<F::volumes>>();
  if (F::stabilised) {
    world.add<HourglassStress>();
    world.add<MinCorner>();
    world.add<HourglassEnergy>();
  }
  if (!needs.plastic) return;
  world.add<IsochoricScale<F::points>>();
  world.add<PlasticMetric<TwoD, F::points>>();
  world.add<PlasticStrain<F::points>>();
  if (F::stabilised) {
    world.add<PlasticHourglass<TwoD>>();
    world.add<HourglassWork>();
  }
}

void add_body_columns(World& world, const Bodies& bodies, const Needs& needs) {
  world.add_table<Node>(rows_by_chunk(bodies, [](const Shape& s) { return s.nodes.size(); }));
  world.add_table<Element>(rows_by_chunk(bodies, [](const Shape& s) { return s.quads.size(); }));
  world.add_table<Particle>(rows_by_chunk(bodies, [](const Shape&) { return 1; }));
  world.add<Position<TwoD>>();
  world.add<Velocity<TwoD>>();
  world.add<InternalForce<TwoD>>();
  with_formulation(bodies.formulation, [&]<class F>(F) { add_element_columns<F>(world, needs); });
  world.add<ShearModulus>();
  world.add<BulkModulus>();
  world.add<Density>();
  world.add<MinJacobian>();
  world.add<WorstElement>();
  world.add<StableTimeStep>();
  world.add<KineticEnergy>();
  world.add<ElasticEnergy>();
  if (needs.bulk_damping) {
    world.add<DampingForce<TwoD>>();
    world.add<MassDamping>();
    world.add<StiffnessDamping>();
    world.add<DampingWork>();
  }
  if (!needs.plastic) return;
  world.add<YieldStress>();
  world.add<HardeningModulus>();
  world.add<PlasticWork>();
  world.add<WorkBeyondHardening>();
  if (needs.flow_laws) world.add<ReturnResidual>();
}

template <class At>
void add_row_columns(World& world, const Needs& needs) {
  world.add_table<At>(std::size_t{0});
  world.add<ContactPair<At>>();
  world.add<ContactTouches<At>>();
  world.add<ActivationTravel<At>>();
  world.add<ContactLaw<At>>();
  world.add<PointForce<At>>();
  if (needs.friction) world.add<ElasticSlip<At>>();
  if (needs.weakening) {
    world.add<FrictionMore<At>>();
    world.add<SlipWeakening<At>>();
  }
  if (needs.adhesion) world.add<AdhesionLaw<At>>();
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
  if (needs.bonds) {
    add_bond_columns<Contact>(world, needs.welds);
    world.add<CurveAnchor>();
  }
  if (needs.tool_bonds) {
    add_bond_columns<ToolContact>(world, needs.tool_welds);
    world.add<ToolAnchor>();
  }
}

void add_contact_columns(World& world, const Bodies& bodies, const Needs& needs) {
  world.add_table<BoundaryNode>(
      rows_by_chunk(bodies, [](const Shape& s) { return s.boundary_nodes; }));
  world.add_table<ControlPoint>(
      rows_by_chunk(bodies, [](const Shape& s) { return lane_count * s.control_points(); }));
  world.add<ContactForce<TwoD>>();
  world.add<CurvePosition>();
  world.add<CurveBefore>();
  world.add<CurveForce>();
  world.add<MaximumSpeed>();
  if (needs.friction || needs.damping) world.add<CurveVelocity>();
  if (needs.pairs) {
    add_row_columns<Contact>(world, needs);
    world.add<ContactPlace>();
    world.add<ClosestPoint>();
    if (needs.friction || needs.bonds) world.add<FrictionCouple>();
  }
  if (needs.tools) add_row_columns<ToolContact>(world, needs);
  if (needs.polylines) world.add<SurfaceRange>();
}

void fill_bodies(World& world, const Layout& layout) {
  auto& x = world.column<Position<TwoD>>();
  auto& v = world.column<Velocity<TwoD>>();
  layout.bodies.for_own_lanes([&](int own) {
    const auto slot = static_cast<std::size_t>(own);
    const Chunk chunk{static_cast<std::int32_t>(slot / lane_count)};
    const int lane = static_cast<int>(slot % lane_count);
    const Placed* placed = layout.placed[slot];
    const Shape& shape = layout.bodies.shape_of_chunk(chunk);
    const auto first =
        static_cast<std::size_t>(x.table.chunk_begin[static_cast<std::size_t>(chunk.index)]);
    const std::vector<Vec2> arms = turned_nodes(shape, placed ? placed->turn : 0);
    for (std::size_t n = 0; n < arms.size(); ++n) {
      const Vec2& arm = arms[n];
      Lane* at = x.lanes() + 2 * (first + n);
      Lane* rate = v.lanes() + 2 * (first + n);
      const Vec2 where = placed ? Vec2(in_plane(placed->body->position) + arm) : arm;
      at[0][lane] = where.x();
      at[1][lane] = where.y();
      if (!placed) continue;
      const double omega = placed->body->angular_velocity.z();
      rate[0][lane] = placed->body->velocity.x() - omega * arm.y();
      rate[1][lane] = placed->body->velocity.y() + omega * arm.x();
    }
  });
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

void fill_materials(World& world, const Scene& scene, const Bodies& bodies) {
  for (std::size_t slot = 0; slot < bodies.slots.size(); ++slot) {
    const MaterialSpec& m = scene.materials[static_cast<std::size_t>(bodies.slots[slot].material)];
    world.column<ShearModulus>().values()[slot] = m.youngs_modulus / (2 * (1 + m.poissons_ratio));
    world.column<BulkModulus>().values()[slot] =
        m.youngs_modulus / (3 * (1 - 2 * m.poissons_ratio));
    world.column<Density>().values()[slot] = m.density;
    if (world.has<MassDamping>()) {
      world.column<MassDamping>().values()[slot] = m.mass_damping;
      world.column<StiffnessDamping>().values()[slot] = m.stiffness_damping;
    }
    if (!world.has<YieldStress>()) continue;
    world.column<YieldStress>().values()[slot] =
        m.yield_stress.value_or(std::numeric_limits<double>::infinity());
    world.column<HardeningModulus>().values()[slot] = m.hardening_modulus;
  }
}

// For materials without one: linear hardening, whose constants are in columns.
FlowLaws flow_laws(const Scene& scene) {
  FlowLaws laws;
  for (const MaterialSpec& m : scene.materials)
    laws.of_material.push_back(m.flow ? *m.flow : FlowLaw{});
  return laws;
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
  world.add_table<Tool>(scene.tools.size());
  world.add<ToolPosition>();
  world.add<ToolVelocity>();
  if (needs.tools) world.add<ToolNormal>();
  world.add<ToolForce>();
  for (std::size_t t = 0; t < scene.tools.size(); ++t)
    for (std::size_t k = 0; k < 2; ++k) {
      const auto axis = static_cast<Eigen::Index>(k);
      if (needs.tools)
        world.column<ToolNormal>().values()[tool_axes * t + k] = scene.tools[t].normal[axis];
      world.column<ToolPosition>().values()[tool_axes * t + k] = start_of(scene.tools[t])[axis];
    }
  if (needs.polylines || needs.constraints) world.emplace<ToolShapes>(tool_shapes(scene));
  add_drives(world, scene, bodies);
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

void add_clock(World& world, const Scene& scene) {
  Clock& clock = world.emplace<Clock>();
  clock.safety = scene.time.safety;
  for (const StageSpec& stage : scene.stages) clock.end += stage.duration;
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
  add_body_columns(*world, layout.bodies, needs);
  if (needs.tools || needs.constraints) add_tools(*world, scene, particles, needs);
  if (needs.contact()) {
    add_contact_columns(*world, layout.bodies, needs);
    add_cell(*world, scene, particles);
    if (scene.cell) add_drives(*world, scene, particles);
    world->emplace<ContactQuality>();
    ContactRules& rules = world->emplace<ContactRules>(contact_rules(scene));
    find_thinnest(scene, layout.bodies, rules);
    rules.servos = world->has<ServoVelocity>();
    ContactIndex& index = world->emplace<ContactIndex>();
    index.skin = scene.contact.skin * rules.shortest_edge;
    if (needs.any_bonds()) {
      add_bonds(*world, needs);
      const BondRules& bonds = world->emplace<BondRules>(
          bounded_by(layout.bodies, surface_springs(layout.bodies), scene, bond_rules(scene)));
      set_stiffest_bonds(bonds, rules);
      index.reach = longest_gap(longest_edge(layout.bodies), bonds);
    }
    index.reach = std::max(index.reach, rules.longest_range());
    index.neighbourhood = skins_of_neighbourhood * index.skin + index.reach;
  }
  if (scene.time.estimate == TimeSpec::Estimate::highest_mode)
    add_highest_mode(*world, layout.bodies, needs.contact());
  if (needs.contact() || needs.constraints) add_hollows(*world, layout.bodies);
  fill_bodies(*world, layout);
  fill_materials(*world, scene, layout.bodies);
  if (needs.flow_laws) world->emplace<FlowLaws>(flow_laws(scene));
  add_clock(*world, scene);
  world->emplace<Totals>();
  if (has_bonds(scene)) {
    BondTotals& totals = world->emplace<BondTotals>();
    totals.made.assign(scene.bonds.size(), 0);
    totals.nearest.resize(scene.bonds.size());
  }
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
