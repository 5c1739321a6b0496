#include "cli/preview/powder_setup.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>

#include "cli/preview/rims.hpp"
#include "cli/preview/stage_setup.hpp"
#include "cli/preview/tool_setup.hpp"
#include "components/bond.hpp"
#include "components/observed.hpp"
#include "engine/enum_table.hpp"
#include "scenes/grains/grains.hpp"
#include "scenes/outlines/outline.hpp"
#include "scenes/tools/contact_rules.hpp"
#include "systems/laws/flow_law.hpp"

namespace pulvis {
namespace {

using nlohmann::json;

constexpr std::array<const char*, 10> outline_names{
    "disc",    "rectangle",      "rounded rectangle", "ring", "ellipse", "superellipse",
    "polygon", "traced outline", "Fourier outline",   "grain"};

static_assert(outline_names.size() == std::variant_size_v<Outline>);

json material_setup(const MaterialSpec& material) {
  json out{{"name", material.name},
           {"density", material.density},
           {"youngs_modulus", material.youngs_modulus},
           {"poissons_ratio", material.poissons_ratio}};
  if (material.yield_stress) out["yield_stress"] = *material.yield_stress;
  if (material.flow) out["flow_law"] = name_of(*material.flow);
  if (material.hardening_modulus > 0) out["hardening_modulus"] = material.hardening_modulus;
  return out;
}

// ---- classes ----------------------------------------------------------------------------------------
struct Size {
  double width = 0, height = 0, diameter = 0;  // m; diameter of the circle of equal area
};

Size size_of(const Outline& outline) {
  constexpr double fine = 1e-3;  // -, deviation of the polygon over the outline's size
  const bool ring = std::holds_alternative<RingOutline>(outline);
  const double area = outline_area(outline);
  Vec2 low = Vec2::Zero(), high = Vec2::Zero();
  for (const Vec2& p : outline_polygon(outline, fine * std::sqrt(area))) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  if (const auto* disc = std::get_if<DiscOutline>(&outline))
    return {disc->diameter, disc->diameter, disc->diameter};
  if (ring) {
    const double diameter = std::get<RingOutline>(outline).diameter;
    return {diameter, diameter, diameter};
  }
  return {high.x() - low.x(), high.y() - low.y(), 2 * std::sqrt(area / std::numbers::pi)};
}

// The class that a packing's size is derived from.
int base_of(const Scene& scene, int particle) {
  const int of = scene.particles[static_cast<std::size_t>(particle)].class_of;
  return of < 0 ? particle : of;
}

struct ClassOf {
  int count = 0;
  std::map<int, int> sizes;  // particle -> count
};

json class_setup(const Scene& scene, int base, const ClassOf& found) {
  const ParticleSpec& spec = scene.particles[static_cast<std::size_t>(base)];
  json out{{"name", spec.name},
           {"material", scene.materials[static_cast<std::size_t>(spec.material)].name},
           {"outline", outline_names[spec.outline.index()]},
           {"count", found.count}};
  for (const auto& [particle, count] : found.sizes) {
    const ParticleSpec& sized = scene.particles[static_cast<std::size_t>(particle)];
    const Size size = size_of(sized.outline);
    widen(out["diameter"], size.diameter);
    widen(out["width"], size.width);
    widen(out["height"], size.height);
  }
  if (const auto* ring = std::get_if<RingOutline>(&spec.outline)) out["hole"] = ring->hole;
  return out;
}

json classes_setup(const Scene& scene, const std::vector<BodySpec>& particles) {
  std::map<int, ClassOf> classes;
  for (const BodySpec& body : particles) {
    ClassOf& of = classes[base_of(scene, body.particle)];
    of.count += 1;
    of.sizes[body.particle] += 1;
  }
  json out = json::array();
  for (const auto& [base, found] : classes) out.push_back(class_setup(scene, base, found));
  return out;
}

// ---- particles --------------------------------------------------------------------------------------
std::vector<Loop> loops_of(const Shape& shape) {
  std::vector<Face> faces;
  for (const auto& quad : shape.quads) {
    faces.emplace_back();
    for (const auto& node : quad) faces.back().push_back(static_cast<std::size_t>(node.value));
  }
  return rims_of(faces);
}

// Points on an edge of the contact curve, a cubic B-spline: at its start, in its middle and at its end.
using EdgePoints = std::array<PlanePoint, 3>;
EdgePoints edge_points_of(const World& world, int slot, const Shape::Edge& edge) {
  const int control =
      entry(world.resource<Bodies>().slots, slot).first_control + edge.first_control;
  const double* c = world.column<CurvePosition>().values() + 2 * static_cast<std::size_t>(control);
  constexpr std::array<std::array<double, 4>, 3> weights{
      {{1.0 / 6, 4.0 / 6, 1.0 / 6, 0},
       {1.0 / 48, 23.0 / 48, 23.0 / 48, 1.0 / 48},
       {0, 1.0 / 6, 4.0 / 6, 1.0 / 6}}};
  EdgePoints points{};
  for (std::size_t at = 0; at < points.size(); ++at)
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t k = 0; k < 2; ++k) points[at][k] += weights[at][i] * c[2 * i + k];
  return points;
}

// x, y, x, y, ...: as seen by contacts with other particles and tools.
json contact_outline(const World& world, int slot) {
  json points = json::array();
  for (const Shape::Edge& edge : world.resource<Bodies>().shape_of_slot(slot).edges) {
    const EdgePoints places = edge_points_of(world, slot, edge);
    for (std::size_t at = 0; at < 2; ++at)  // the end is the start of the next edge
      for (const double coordinate : places[at]) points.push_back(coordinate);
  }
  return points;
}

// The outline first, then the boundaries of holes.
json particle_setup(const World& world, int slot, const std::vector<Loop>& loops) {
  const auto& x = world.column<Position<TwoD>>();
  const ChunkLane place(slot);
  const auto first =
      static_cast<std::size_t>(x.table.chunk_begin[static_cast<std::size_t>(place.chunk.index)]);
  json out = json::array();
  for (const Loop& loop : loops) {
    json points = json::array();
    for (const std::size_t node : loop)
      for (std::size_t k = 0; k < 2; ++k)
        points.push_back(x.lanes()[2 * (first + node) + k][place.lane]);
    out.push_back(std::move(points));
  }
  if (world.has<CurvePosition>()) out[0] = contact_outline(world, slot);
  return out;
}

json particles_setup(const Scene& scene, const std::vector<BodySpec>& particles,
                     const World& world) {
  const auto& bodies = world.resource<Bodies>();
  std::vector<std::vector<Loop>> loops;
  for (const Shape& shape : bodies.shapes) loops.push_back(loops_of(shape));
  json out = json::array();
  for (int number = 0; number < bodies.particles(); ++number) {
    const int slot = entry(bodies.slot_of_number, number);
    const Bodies::Slot& of = entry(bodies.slots, slot);
    // A grain belongs to a particle; a particle without grains is its own parent.
    const int parent = of.parent == Bodies::empty_slot ? number : of.parent;
    const BodySpec& body = entry(particles, parent);
    json one{
        {"particle", parent},
        {"class", scene.particles[static_cast<std::size_t>(base_of(scene, body.particle))].name},
        {"material", scene.materials[static_cast<std::size_t>(of.material)].name},
        {"loops", particle_setup(world, slot, entry(loops, of.shape))},
        {"elements", entry(bodies.shapes, of.shape).elements()}};
    if (body.velocity.norm() > 0) one["velocity"] = {body.velocity.x(), body.velocity.y()};
    if (body.angular_velocity.z() != 0) one["angular_velocity"] = body.angular_velocity.z();
    out.push_back(std::move(one));
  }
  return out;
}

// ---- bonds ------------------------------------------------------------------------------------------
template <class At>
void add_bonded_edges(const World& world, json& out) {
  if (!world.has<BondedPoints<At>>()) return;
  const auto& pair = world.column<ContactPair<At>>();
  const auto& bonded = world.column<BondedPoints<At>>();
  for (std::size_t r = 0; r < pair.table.rows; ++r) {
    if (bonded.values()[r] == 0) continue;
    const std::int32_t* key = pair.values() + 3 * r;
    const auto& edges = world.resource<Bodies>().shape_of_slot(key[0]).edges;
    json points = json::array();
    for (const PlanePoint& point : edge_points_of(world, key[0], entry(edges, key[1])))
      points.push_back(json::array({point[0], point[1]}));
    out.push_back(std::move(points));
  }
}

constexpr EnumTable<BondSpec::Origin> bond_origins{"initial", "pressed", "adhesion"};

json bonds_setup(const Scene& scene, const World& world) {
  json edges = json::array();
  add_bonded_edges<Contact>(world, edges);
  add_bonded_edges<ToolContact>(world, edges);
  return {{"laws", bond_laws(scene)}, {"edges", edges}};
}

}  // namespace

void widen(json& range, double value) {
  if (range.is_null()) range = {value, value};
  range[0] = std::min(range[0].get<double>(), value);
  range[1] = std::max(range[1].get<double>(), value);
}

json bond_laws(const Scene& scene) {
  json laws = json::array();
  for (const BondSpec& bond : scene.bonds) {
    json law{{"first", bond.first},
             {"second", bond.second},
             {"origin", bond_origins[bond.origin]},
             {"inside", bond.inside}};
    if (bond.strength) law["strength"] = *bond.strength;
    if (bond.work > 0) law.update({{"work", bond.work}, {"range", bond.range}});
    laws.push_back(std::move(law));
  }
  return laws;
}

json materials_setup(const Scene& scene) {
  json out = json::array();
  for (const MaterialSpec& material : scene.materials) out.push_back(material_setup(material));
  return out;
}

json pairs_setup(const Scene& scene) {
  json out = json::array();
  for (std::size_t a = 0; a < scene.materials.size(); ++a)
    for (std::size_t b = a; b < scene.materials.size(); ++b) {
      const std::string &first = scene.materials[a].name, &second = scene.materials[b].name;
      out.push_back({{"first", first},
                     {"second", second},
                     {"coefficient", friction_of(scene, first, second).coefficient}});
    }
  return out;
}

json powder_setup(const Scene& scene, const std::vector<BodySpec>& particles, const World& world) {
  json setup{
      {"family", "particles"},          {"thickness", scene.thickness},
      {"friction", pairs_setup(scene)}, {"particles", particles_setup(scene, particles, world)},
      {"count", particles.size()},      {"classes", classes_setup(scene, particles)},
      {"stages", stage_setup(scene)},   {"bonds", bonds_setup(scene, world)},
      {"cell", cell_setup(world)}};
  setup["materials"] = materials_setup(scene);
  setup["tools"] = scene.tools.empty() ? json::array() : tool_setup(scene, world);
  setup["die"] = die_setup(scene, setup["tools"]);
  if (scene.output.density()) setup["density_cells"] = scene.output.density_cells;
  if (scene.initial_state) setup["initial_state"] = *scene.initial_state;
  return setup;
}

}  // namespace pulvis
