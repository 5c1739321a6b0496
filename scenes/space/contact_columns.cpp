#include "scenes/space/contact_columns.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "components/body.hpp"
#include "components/observed.hpp"
#include "components/run_state.hpp"
#include "components/space/bond.hpp"
#include "components/space/contact.hpp"
#include "components/space/tools.hpp"
#include "scenes/space/tools/tool_shapes.hpp"
#include "scenes/spec/tool_motion.hpp"
#include "scenes/tools/bond_rules.hpp"
#include "scenes/tools/constraints.hpp"
#include "scenes/tools/contact_rules.hpp"

namespace pulvis::space {
namespace {

// Surfaces must move by this many skins relative to each other before non-neighbours can come close.
constexpr double skins_of_neighbourhood = 8;

ContactRules rules_of(const Scene& scene) {
  ContactRules rules = contact_rules(scene);
  rules.tool_thickness.assign(scene.tools.size(), std::numeric_limits<double>::infinity());
  rules.servos = has_servos(scene);
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

struct Touching {  // what can touch, and how
  bool pairs, tools, friction, weakening, damping;

  Touching(const Scene& scene, const ContactRules& rules, std::size_t bodies) {
    pairs = bodies > 1;
    tools = has_contact_tools(scene);
    const auto any = [&](const auto& is) {
      return (pairs && std::ranges::any_of(rules.friction, is)) ||
             (tools && std::ranges::any_of(rules.tool_friction, is));
    };
    friction = any([](const ContactRules::Friction& f) { return f.acts(); });
    weakening = friction && any([](const ContactRules::Friction& f) { return !f.only_coulomb(); });
    damping = rules.damping > 0;
  }
};

// ---- bonds -------------------------------------------------------------------------------------------
// Which kinds of bonds there can be.
struct Bonding {
  bool initial = false, pressed = false;  // between particles
  bool tool_initial = false, tool_pressed = false;

  Bonding(const Touching& touching, const BondRules& rules) {
    initial = touching.pairs && BondRules::any(rules.initial);
    pressed = touching.pairs && BondRules::any(rules.pressed);
    tool_initial = touching.tools && BondRules::any(rules.tool_initial);
    tool_pressed = touching.tools && BondRules::any(rules.tool_pressed);
  }
};

template <class At>
void add_bond_columns(World& world, bool initial, bool pressed) {
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
double add_bonds(World& world, const Scene& scene, const Touching& touching, ContactRules& rules) {
  const Shapes& shapes = world.resource<Shapes>();
  const BondRules& bonds = world.emplace<BondRules>(
      bounded_by(world.resource<Bodies>(), surface_springs(shapes), scene, bond_rules(scene)));
  const Bonding kinds(touching, bonds);
  if (kinds.initial || kinds.pressed) {
    add_bond_columns<FaceContact>(world, kinds.initial, kinds.pressed);
    world.emplace<BondSums<Contact>>();
  }
  if (kinds.tool_initial || kinds.tool_pressed) {
    add_bond_columns<FaceToolContact>(world, kinds.tool_initial, kinds.tool_pressed);
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

void add_surfaces(World& world, const Touching& touching) {
  world.add_table<BoundaryNode>(of_chunks(world, [](const Shape& s) { return s.boundary_nodes; }));
  world.add_table<SurfacePoint>(
      of_chunks(world, [](const Shape& s) { return s.surface_points(); }));
  world.add_table<ParticleSurface>(
      of_chunks(world, [](const Shape& s) { return lane_count * s.surface_points(); }));
  world.add_table<SurfaceFace>(of_chunks(
      world, [](const Shape& s) { return lane_count * static_cast<int>(s.faces.size()); }));
  number_surfaces(world);
  world.add<ContactForce<ThreeD>>();
  world.add<NetPosition>();
  world.add<NetLoad>();
  world.add<PointPosition>();
  world.add<PointLoad>();
  world.add<SurfacePosition>();
  world.add<SurfaceBefore>();
  world.add<FaceForce>();
  world.add<MaximumSpeed>();
  world.add<Roughness>();
  world.add<NodeDistance>();
  if (touching.friction || touching.damping) world.add<SurfaceVelocity>();
}

template <class At>
void add_rows(World& world) {
  world.add_table<At>(std::size_t{0});
  world.add<ContactPair<At>>();
  world.add<ContactTouches<At>>();
  world.add<Activation<At>>();
  world.add<ContactLaw<At>>();
}

void add_pairs(World& world, const Touching& touching) {
  add_rows<FaceContact>(world);
  world.add<ContactPoint>();
  if (touching.weakening) world.add<SlipWeakening<FaceContact>>();
  world.emplace<FacePairs>();
  world.emplace<PairLoads>();
  world.emplace<ContactSums<Contact>>();
}

void add_tools(World& world, const Scene& scene, const Touching& touching) {
  add_rows<FaceToolContact>(world);
  world.add<PointForce<FaceToolContact>>();
  if (touching.friction) world.add<ElasticSlip<FaceToolContact>>();
  if (touching.weakening) world.add<SlipWeakening<FaceToolContact>>();
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

void add_contact(World& world, const Scene& scene, const std::vector<BodySpec>& bodies) {
  ContactRules rules = rules_of(scene);
  const Touching touching(scene, rules, bodies.size());
  if (has_bonds(scene)) {
    BondTotals& totals = world.emplace<BondTotals>();
    totals.made.assign(scene.bonds.size(), 0);
    totals.nearest.resize(scene.bonds.size());
    world.emplace<Fragments>();
  }
  if (!touching.pairs && !touching.tools) return;
  find_smallest(world.resource<Shapes>(), rules);
  add_surfaces(world, touching);
  if (touching.pairs) add_pairs(world, touching);
  if (touching.tools) add_tools(world, scene, touching);
  ContactIndex& index = world.emplace<ContactIndex>();
  index.skin = scene.contact.skin * rules.shortest_edge;
  index.reach = rules.longest_range();
  if (has_bonds(scene))
    index.reach = std::max(index.reach, add_bonds(world, scene, touching, rules));
  index.neighbourhood = skins_of_neighbourhood * index.skin + index.reach;
  world.emplace<ContactRules>(std::move(rules));
  world.emplace<ContactQuality>();
}

}  // namespace pulvis::space
