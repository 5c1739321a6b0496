#include "cli/preview/outline_setup.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "cli/preview/powder_setup.hpp"
#include "cli/preview/rims.hpp"
#include "cli/preview/tool_setup.hpp"
#include "components/bond.hpp"
#include "components/observed.hpp"
#include "scenes/grains/grains.hpp"
#include "scenes/outlines/outline.hpp"

namespace pulvis {
namespace {

using nlohmann::json;

constexpr std::array<const char*, 10> outline_names{
    "disc",    "rectangle",      "rounded rectangle", "ring", "ellipse", "superellipse",
    "polygon", "traced outline", "Fourier outline",   "grain"};

static_assert(outline_names.size() == std::variant_size_v<Outline>);

ClassSize size_of(const Outline& outline) {
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
  return {2 * std::sqrt(area / std::numbers::pi), high.x() - low.x(), high.y() - low.y()};
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
    json one{{"particle", parent},
             {"class", base_of(scene, body).name},
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

}  // namespace

json outline_class(const ParticleSpec& particle) {
  json out{{"outline", outline_names[particle.outline.index()]}};
  if (const auto* ring = std::get_if<RingOutline>(&particle.outline)) out["hole"] = ring->hole;
  return out;
}

ClassSize outline_size(const ParticleSpec& particle) { return size_of(particle.outline); }

json outline_setup(const Scene& scene, const std::vector<BodySpec>& particles, const World& world) {
  json edges = json::array();
  add_bonded_edges<Contact>(world, edges);
  add_bonded_edges<ToolContact>(world, edges);
  json setup{{"thickness", scene.thickness},
             {"particles", particles_setup(scene, particles, world)},
             {"bonds", {{"edges", edges}}},
             {"cell", cell_setup(world)}};
  setup["tools"] = scene.tools.empty() ? json::array() : tool_setup(scene, world);
  setup["die"] = die_setup(scene, setup["tools"]);
  if (scene.output.density()) setup["density_cells"] = scene.output.density_cells;
  return setup;
}

}  // namespace pulvis
