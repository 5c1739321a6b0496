#include "scenes/tools/constraints.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <tuple>

#include "components/dimension.hpp"
#include "components/inertance.hpp"
#include "components/shape.hpp"
#include "components/space/shape.hpp"
#include "components/surface.hpp"
#include "scenes/language/problem.hpp"

namespace pulvis {
namespace {

constexpr double round_off =
    1e-9;  // of the body's size: how far outside its box or circle a node may lie

struct Held {
  std::int32_t chunk, node, lane, tool;
  Vec3 place;
  Vec3 direction = Vec3::Zero();
  Vec3 travel = Vec3::Zero();  // of the node, along `direction`, per displacement of the tool
};

[[noreturn]] void refuse(const Scene& scene, int tool, const std::string& key,
                         const std::string& message) {
  const SourceMark& mark = scene.tools[static_cast<std::size_t>(tool)].mark;
  throw SceneError({{scene.file_of(mark).string(), mark.line, mark.column, "",
                     fmt::format("tool[{}].{}", tool, key), message}});
}

double size_of(const std::vector<Vec3>& places) {
  double size = 0;
  for (const Vec3& p : places) size = std::max(size, (p - places.front()).norm());
  return size;
}

void hold_node(const Scene& scene, const Held& node, double size, std::vector<Held>& held) {
  const ToolSpec& tool = scene.tools[static_cast<std::size_t>(node.tool)];
  const auto add = [&](const Vec3& direction, const Vec3& travel) {
    held.push_back(node);
    held.back().direction = direction;
    held.back().travel = travel;
  };
  for (int axis = 0; axis < scene.dimension; ++axis)
    if (holds_axis(tool.holds, axis)) add(Vec3::Unit(axis), Vec3::Unit(axis));
  if (tool.holds != ToolSpec::Holds::radial) return;
  const Vec3 arm = node.place - tool.point;
  if (arm.norm() <= round_off * size)
    refuse(scene, node.tool, "point",
           fmt::format("node {} of particle {} lies at the centre, where the radial direction is "
                       "undefined, allowed: a point where the constraint holds no node",
                       node.node, tool.body));
  add(arm.normalized(), Vec3::UnitX());
}

bool holds_place(const ToolSpec& tool, const Vec3& place, double margin) {
  if (tool.radius) return (place - tool.point).norm() <= *tool.radius + margin;
  return (place.array() >= tool.low.array() - margin).all() &&
         (place.array() <= tool.high.array() + margin).all();
}

[[noreturn]] void refuse_empty(const Scene& scene, int number, const std::vector<Vec3>& places) {
  const ToolSpec& tool = scene.tools[static_cast<std::size_t>(number)];
  if (!tool.radius)
    refuse(scene, number, "low",
           fmt::format("no node of particle {} lies in the box, allowed: a box with at least one "
                       "node in it",
                       tool.body));
  double nearest = std::numeric_limits<double>::infinity();
  for (const Vec3& place : places) nearest = std::min(nearest, (place - tool.point).norm());
  refuse(scene, number, "radius",
         fmt::format("no node of particle {} lies within it, allowed: at least {:.6g} m, the "
                     "distance of the nearest one",
                     tool.body, nearest));
}

// All grains of a particle count as the particle.
int particle_in(const Bodies::Slot& slot) {
  return slot.parent == Bodies::empty_slot ? slot.number : slot.parent;
}

std::vector<Held> held_by(const Scene& scene, const Bodies& bodies, const NodePlaces& places_of,
                          int number) {
  const ToolSpec& tool = scene.tools[static_cast<std::size_t>(number)];
  int last = 0;
  for (const Bodies::Slot& slot : bodies.slots) last = std::max(last, particle_in(slot));
  if (tool.body > last)
    refuse(scene, number, "body",
           fmt::format("there is no particle {}, allowed: >= 0 and <= {}", tool.body, last));
  std::vector<Vec3> all;
  std::vector<Held> held;
  for (int slot = 0; slot < static_cast<int>(bodies.slots.size()); ++slot) {
    if (particle_in(entry(bodies.slots, slot)) != tool.body) continue;
    const std::vector<Vec3> places = places_of(slot);
    const double size = size_of(places);
    for (std::size_t n = 0; n < places.size(); ++n)
      if (holds_place(tool, places[n], round_off * size))
        hold_node(
            scene,
            {slot / lane_count, static_cast<std::int32_t>(n), slot % lane_count, number, places[n]},
            size, held);
    all.insert(all.end(), places.begin(), places.end());
  }
  if (held.empty()) refuse_empty(scene, number, all);
  return held;
}

std::string place_text(const Scene& scene, const Vec3& at) {
  return scene.in_space() ? fmt::format("({:.6g}, {:.6g}, {:.6g})", at.x(), at.y(), at.z())
                          : fmt::format("({:.6g}, {:.6g})", at.x(), at.y());
}

// Two constraints may hold a node only at right angles: otherwise they conflict.
void check_shared(const Scene& scene, const std::vector<Held>& sorted) {
  for (std::size_t i = 0; i < sorted.size(); ++i)
    for (std::size_t j = i + 1; j < sorted.size(); ++j) {
      const Held &a = sorted[i], &b = sorted[j];
      if (std::tie(a.chunk, a.lane, a.node) != std::tie(b.chunk, b.lane, b.node)) break;
      if (std::abs(a.direction.dot(b.direction)) < round_off) continue;
      refuse(scene, std::max(a.tool, b.tool), "holds",
             fmt::format("node {} of particle {} at {} m is held by '{}' and '{}' in "
                         "the same direction, allowed: one constraint, or two at right angles",
                         a.node, scene.tools[static_cast<std::size_t>(a.tool)].body,
                         place_text(scene, a.place),
                         scene.tools[static_cast<std::size_t>(a.tool)].name,
                         scene.tools[static_cast<std::size_t>(b.tool)].name));
    }
}

template <class D>
const typename D::Shape& shape_of_chunk(const World& world, int chunk) {
  const Bodies& bodies = world.resource<Bodies>();
  if constexpr (D::axes == 2)
    return bodies.shape_of_chunk(Chunk{chunk});
  else
    return entry(world.resource<space::Shapes>().list,
                 entry(bodies.slots, chunk * lane_count).shape);
}

// A reaction moves a node as if it had its own mass alone: no inerter may act on it. Between two nodes held alike, normal to their
// line, one has no force that the reaction would have to balance.
bool held_alike(const Held& a, const Held& b) {
  const Vec3 line = b.place - a.place;
  return a.tool == b.tool && std::abs(a.direction.dot(line)) < round_off * line.norm() &&
         std::abs(b.direction.dot(line)) < round_off * line.norm();
}

template <class D>
void remove_inerters(World& world, const std::vector<Held>& by_node) {
  const Bodies& bodies = world.resource<Bodies>();
  auto& inertance = world.column<Inertance>();
  const auto place = [](const Held& h) { return std::tie(h.chunk, h.lane); };
  for (auto first = by_node.begin(); first != by_node.end();) {
    const auto last = std::find_if(first, by_node.end(),
                                   [&](const Held& h) { return place(h) != place(*first); });
    if (bodies.owns(first->chunk * lane_count + first->lane)) {
      const auto held = [&](Row<Node> node) {
        const auto before = [](const Held& h, std::int32_t n) { return h.node < n; };
        const auto begin = std::lower_bound(first, last, node.value, before);
        return std::span(begin, std::lower_bound(begin, last, node.value + 1, before));
      };
      Lane* of_chunk = inertance.lanes() + entry(inertance.table.chunk_begin, first->chunk);
      for (const InerterChains::Chain& chain : shape_of_chunk<D>(world, first->chunk).chains.all)
        for (int i = 0; i < chain.links; ++i) {
          const Row<Node> node = entry(chain.nodes, i);
          const auto of = held(node),
                     of_next = held(entry(chain.nodes, next_in_chain(i, chain.links)));
          if (of.empty() && of_next.empty()) continue;
          if (of.size() == 1 && of_next.size() == 1 && held_alike(of.front(), of_next.front()))
            continue;
          of_chunk[node.value][first->lane] = 0;
        }
    }
    first = last;
  }
}

template <class D>
void fill(World& world, const std::vector<Held>& held) {
  const Bodies& bodies = world.resource<Bodies>();
  for (std::size_t r = 0; r < held.size(); ++r) {
    const Held& h = held[r];
    if (!bodies.owns(h.chunk * lane_count + h.lane)) continue;
    std::int32_t* target = world.column<ConstraintTarget>().values() + 3 * r;
    std::tie(target[0], target[1], target[2]) = std::tie(h.node, h.lane, h.tool);
    for (std::size_t k = 0; k < D::axes; ++k) {
      const auto axis = static_cast<Eigen::Index>(k);
      world.column<ConstraintDirection<D>>().values()[D::axes * r + k] = h.direction[axis];
      world.column<ConstraintTravel<D>>().values()[D::axes * r + k] = h.travel[axis];
    }
    world.column<ConstraintOrigin>().values()[r] = h.direction.dot(h.place);
  }
}

}  // namespace

Vec3 start_of(const ToolSpec& tool) {
  if (tool.shape == ToolSpec::Shape::polyline) return in_space(tool.points.front());
  if (is_constraint(tool) && tool.holds != ToolSpec::Holds::radial && !tool.radius)
    return (tool.low + tool.high) / 2;
  return tool.point;
}

template <class D>
void add_constraints(World& world, const Scene& scene, const NodePlaces& places_of) {
  const Bodies& bodies = world.resource<Bodies>();
  std::vector<Held> held;
  for (std::size_t t = 0; t < scene.tools.size(); ++t) {
    if (!is_constraint(scene.tools[t])) continue;
    const std::vector<Held> own = held_by(scene, bodies, places_of, static_cast<int>(t));
    held.insert(held.end(), own.begin(), own.end());
  }
  std::vector<Held> by_node = held;
  std::ranges::stable_sort(by_node, {},
                           [](const Held& h) { return std::tie(h.chunk, h.lane, h.node); });
  check_shared(scene, by_node);
  std::ranges::stable_sort(held, {}, &Held::chunk);

  std::vector<std::int32_t> rows(static_cast<std::size_t>(bodies.chunks()), 0);
  for (const Held& h : held) rows[static_cast<std::size_t>(h.chunk)] += 1;
  world.add_table<ConstrainedNode>(rows);
  world.add<ConstraintTarget>();
  world.add<ConstraintDirection<D>>();
  world.add<ConstraintTravel<D>>();
  world.add<ConstraintOrigin>();
  world.add<ConstraintReaction>();
  world.emplace<ConstraintIndex>().begin = world.table<ConstrainedNode>().chunk_begin;
  fill<D>(world, held);
  if (world.has<Inertance>()) remove_inerters<D>(world, by_node);
}
template void add_constraints<TwoD>(World& world, const Scene& scene, const NodePlaces& places_of);
template void add_constraints<ThreeD>(World& world, const Scene& scene,
                                      const NodePlaces& places_of);

}  // namespace pulvis
