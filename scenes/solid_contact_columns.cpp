#include "scenes/solid_contact_columns.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "components/body.hpp"
#include "components/observed.hpp"
#include "components/run_state.hpp"
#include "components/servo.hpp"
#include "components/space/bond.hpp"
#include "components/space/contact.hpp"
#include "components/space/tools.hpp"
#include "scenes/body_columns.hpp"
#include "scenes/contact_search.hpp"
#include "scenes/tools/bond_rules.hpp"
#include "scenes/tools/constraints.hpp"
#include "scenes/tools/contact_rules.hpp"
#include "scenes/tools/surfaces/tool_shapes.hpp"

namespace pulvis::space {
namespace {

ContactRules rules_of(const World& world, const Scene& scene) {
  ContactRules rules = contact_rules(scene);
  rules.tool_thickness.assign(scene.tools.size(), std::numeric_limits<double>::infinity());
  rules.servos = world.has<ServoVelocity>();
  return rules;
}

// m, the minimum of an element at its centre.
double edge_of(const Shape::Element& element) {
  double steepest = 0;
  for (std::size_t k = 0; k < 9; k += 3) {
    const auto& rows = element.fibre;  // of length 1/4 over an edge
    steepest = std::max(steepest,
                        rows[k] * rows[k] + rows[k + 1] * rows[k + 1] + rows[k + 2] * rows[k + 2]);
  }
  return 0.25 / std::sqrt(steepest);
}

// What surfaces could pass through.
void find_smallest(const Shapes& shapes, ContactRules& rules) {
  rules.shortest_edge = std::numeric_limits<double>::max();
  for (const Shape& shape : shapes.list) {
    for (const Shape::Face& face : shape.faces)
      rules.shortest_edge = std::min(rules.shortest_edge, face.size);
    for (const Shape::Element& element : shape.element)
      rules.thinnest = std::min(rules.thinnest, edge_of(element));
  }
  rules.thinnest = std::min(rules.thinnest, rules.shortest_edge);
}

template <class At>
void add_face_bond_columns(World& world, bool initial, bool pressed) {
  world.add<BondedPoints<At>>();
  world.add<BondDamage<At>>();
  world.add<BondStrength<At>>();
  if (initial) world.add<BondOffset<At>>();
  if (pressed) world.add<WeldPressure<At>>();
}

std::vector<SurfaceSprings> surface_springs(const Shapes& shapes) {
  std::vector<SurfaceSprings> all;
  for (const Shape& shape : shapes.list) {
    SurfaceSprings of{std::numeric_limits<double>::infinity(), shape.mean_face_stiffness};
    for (const Shape::Face& face : shape.faces) of.softest = std::min(of.softest, face.stiffness);
    all.push_back(of);
  }
  return all;
}

double largest_face(const Shapes& shapes) {
  double largest = 0;
  for (const Shape& shape : shapes.list)
    for (const Shape::Face& face : shape.faces) largest = std::max(largest, face.size);
  return largest;
}

// Returns how far bonds reach. (m)
double add_face_bonds(World& world, const Scene& scene, const Needs& needs, ContactRules& rules) {
  const Shapes& shapes = world.resource<Shapes>();
  const BondRules& bonds = world.emplace<BondRules>(
      bounded_by(world.resource<Bodies>(), surface_springs(shapes), scene, bond_rules(scene)));
  if (needs.bonds()) {
    add_face_bond_columns<FaceContact>(world, needs.initial_bonds, needs.welds);
    world.emplace<BondSums<Contact>>();
  }
  if (needs.tool_bonds()) {
    add_face_bond_columns<FaceToolContact>(world, needs.tool_initial_bonds, needs.tool_welds);
    world.add<ToolAnchor>();
    world.emplace<BondSums<ToolContact>>();
  }
  set_stiffest_bonds(bonds, rules);
  return longest_gap(largest_face(shapes), bonds);
}

// The number of rows of each chunk, where `count` gives that of one particle.
template <class Count>
std::vector<std::int32_t> of_chunks(const World& world, const Count& count) {
  const Bodies& bodies = world.resource<Bodies>();
  const Shapes& shapes = world.resource<Shapes>();
  std::vector<std::int32_t> rows;
  for (int slot = 0; slot < static_cast<int>(bodies.slots.size()); slot += lane_count)
    rows.push_back(
        static_cast<std::int32_t>(count(entry(shapes.list, entry(bodies.slots, slot).shape))));
  return rows;
}
void number_surfaces(World& world) {
  const Shapes& shapes = world.resource<Shapes>();
  int first = 0;
  for (Bodies::Slot& slot : world.resource<Bodies>().slots) {
    slot.first_control = first;
    first += entry(shapes.list, slot.shape).surface_points();
  }
}

void add_surfaces(World& world, const Needs& needs) {
  world.add_table<BoundaryNode>(of_chunks(world, [](const Shape& s) { return s.boundary_nodes; }));
  world.add_table<SurfacePoint>(
      of_chunks(world, [](const Shape& s) { return s.surface_points(); }));
  world.add_table<ParticleSurface>(
      of_chunks(world, [](const Shape& s) { return lane_count * s.surface_points(); }));
  world.add_table<SurfaceFace>(of_chunks(
      world, [](const Shape& s) { return lane_count * static_cast<int>(s.faces.size()); }));
  world.add_table<WholeSurface>(of_chunks(world, [](const Shape&) { return lane_count; }));
  number_surfaces(world);
  world.add<ContactForce<ThreeD>>();
  world.add<NetPosition>();
  world.add<NetVelocity>();
  world.add<NetLoad>();
  world.add<PointLoad>();
  world.add<SurfacePosition>();
  world.add<SurfaceBefore>();
  world.add<FaceForce>();
  world.add<MaximumSpeed>();
  world.add<SurfaceMotion>();
  world.add<Roughness>();
  world.add<NodeDistance>();
  if (needs.friction || needs.damping) world.add<SurfaceVelocity>();
  if (needs.indentation) world.add<SurfaceHardness<ThreeD>>();
}

template <class At>
void add_rows(World& world) {
  world.add_table<At>(std::size_t{0});
  world.add<ContactPair<At>>();
  world.add<ContactTouches<At>>();
  world.add<ReactivationDistance<At>>();
  world.add<ContactLaw<At>>();
}

void add_pairs(World& world, const Needs& needs) {
  add_rows<FaceContact>(world);
  world.add<RowTravel>();
  world.add<ContactPoint>();
  if (needs.indentation) world.add<PointIndentation<FaceContact>>();
  if (needs.weakening) world.add<SlipWeakening<FaceContact>>();
  world.emplace<FacePairs>();
  world.emplace<PairLoads>();
  world.emplace<ContactSums<Contact>>();
}

void add_tool_contact(World& world, const Scene& scene, const Needs& needs) {
  add_rows<FaceToolContact>(world);
  world.add<PointForce<FaceToolContact>>();
  if (needs.indentation) world.add<PointIndentation<FaceToolContact>>();
  if (needs.friction) world.add<ElasticSlip<FaceToolContact>>();
  if (needs.weakening) world.add<SlipWeakening<FaceToolContact>>();
  world.emplace<RowBlocks<FaceToolContact>>();
  world.emplace<ContactSums<ToolContact>>();
  const ToolShapes& shapes = world.emplace<ToolShapes>(tool_shapes(scene));
  const bool meshes = std::ranges::any_of(shapes.of_tool, [](const ToolShapes::Shape& shape) {
    return shape.kind == ToolShapes::Kind::mesh;
  });
  if (!meshes) return;
  world.add<TriangleRange>();
  world.emplace<TriangleLists>();
}

}  // namespace

void add_contact(World& world, const Scene& scene, const Needs& needs) {
  ContactRules rules = rules_of(world, scene);
  add_bond_totals(world, scene);
  if (has_bonds(scene)) world.emplace<Fragments>();
  if (!needs.contact()) return;
  find_smallest(world.resource<Shapes>(), rules);
  add_surfaces(world, needs);
  if (needs.inerters) add_inerters(world, rules);
  if (needs.pairs) add_pairs(world, needs);
  if (needs.tools) add_tool_contact(world, scene, needs);
  ContactIndex& index = world.emplace<ContactIndex>();
  const double bonds = has_bonds(scene) ? add_face_bonds(world, scene, needs, rules) : 0;
  set_reach(index, scene, rules, bonds);
  world.emplace<ContactRules>(std::move(rules));
  world.emplace<ContactQuality>();
}

}  // namespace pulvis::space
