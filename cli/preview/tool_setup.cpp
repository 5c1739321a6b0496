#include "cli/preview/tool_setup.hpp"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <set>

#include "components/contact.hpp"
#include "components/surface.hpp"
#include "engine/enum_table.hpp"
#include "scenes/tools/cell.hpp"
#include "scenes/tools/constraints.hpp"
#include "scenes/tools/contact_rules.hpp"
#include "scenes/tools/die_sides.hpp"
#include "scenes/tools/surface.hpp"

namespace pulvis {
namespace {

using nlohmann::json;

json point_of(const Vec2& v) { return {v.x(), v.y()}; }
json point_of(const Scene& scene, const Vec3& v) {
  return scene.in_space() ? json{v.x(), v.y(), v.z()} : point_of(in_plane(v));
}

// By material; for a pair with a contact law of its own, that law's sliding coefficient.
json friction_setup(const Scene& scene, const ToolSpec& tool) {
  json out = json::object();
  for (const MaterialSpec& material : scene.materials)
    out[material.name] = friction_of(scene, tool.name, material.name).coefficient;
  return out;
}

// Positions of the nodes that it holds.
template <class D>
json held_nodes(const World& world, int tool) {
  const auto& target = world.column<ConstraintTarget>();
  const auto& begin = world.resource<ConstraintIndex>().begin;
  const auto& x = world.column<Position<D>>();
  std::set<typename D::Point> places;
  for (std::size_t chunk = 0; chunk + 1 < begin.size(); ++chunk)
    for (auto row = begin[chunk]; row < begin[chunk + 1]; ++row) {
      const std::int32_t* of = target.values() + 3 * static_cast<std::size_t>(row);
      if (of[2] != tool) continue;
      const auto node = static_cast<std::size_t>(x.table.chunk_begin[chunk] + of[0]);
      typename D::Point place;
      for (std::size_t k = 0; k < D::axes; ++k) place[k] = x.lanes()[D::axes * node + k][of[1]];
      places.insert(place);
    }
  return places;
}

json touching_setup(const Scene& scene, const ToolSpec& tool, const Vec2& position) {
  json out{{"normal", point_of(face_normal(tool))},
           {"point", point_of(position)},
           {"friction", friction_setup(scene, tool)}};
  out["shape"] = tool_shape_names[tool.shape];
  if (tool.shape == ToolSpec::Shape::plane) return out;
  out["points"] = json::array();
  for (const Vec2& point : drawn_points(make_surface(tool.points, tool.rounding)))
    out["points"].push_back(point_of(position + point));
  return out;
}

// The face of a tool: for a polyline its innermost point towards the powder.
double face_of(const json& tool, const char* axis, bool largest) {
  const std::size_t k = axis[0] == 'x' ? 0 : 1;
  if (!tool.contains("points")) return tool["point"][k];
  std::vector<double> places;
  for (const json& point : tool["points"]) places.push_back(point[k]);
  return largest ? *std::ranges::max_element(places) : *std::ranges::min_element(places);
}

}  // namespace

json constraint_setup(const Scene& scene, const World& world, int number) {
  static constexpr EnumTable<ToolSpec::Holds> directions{"x", "y", "both", "radial", "z", "all"};
  const ToolSpec& tool = scene.tools[static_cast<std::size_t>(number)];
  json out{{"shape", "constraint"},
           {"holds", directions[tool.holds]},
           {"nodes", scene.in_space() ? held_nodes<ThreeD>(world, number)
                                      : held_nodes<TwoD>(world, number)}};
  if (tool.radius) {
    out["point"] = point_of(scene, tool.point);
    out["radius"] = *tool.radius;
  } else {
    out["low"] = point_of(scene, tool.low);
    out["high"] = point_of(scene, tool.high);
  }
  return out;
}

json tool_setup(const Scene& scene, const World& world) {
  json tools = json::array();
  for (std::size_t t = 0; t < scene.tools.size(); ++t) {
    const ToolSpec& tool = scene.tools[t];
    const double* at = world.column<ToolPosition>().values() + tool_axes * t;
    json out = is_constraint(tool) ? constraint_setup(scene, world, static_cast<int>(t))
                                   : touching_setup(scene, tool, {at[0], at[1]});
    out["name"] = tool.name;
    tools.push_back(std::move(out));
  }
  return tools;
}

json die_setup(const Scene& scene, const json& tools) {
  const auto sides = die_sides(scene);
  if (!sides) return nullptr;
  const auto [left, right, bottom, top] = *sides;
  const auto tool = [&](int number) -> const json& {
    return tools[static_cast<std::size_t>(number)];
  };
  return {{"left", tool(left)["name"]},
          {"right", tool(right)["name"]},
          {"bottom", tool(bottom)["name"]},
          {"top", tool(top)["name"]},
          {"x", {face_of(tool(left), "x", true), face_of(tool(right), "x", false)}},
          {"y", {face_of(tool(bottom), "y", true), face_of(tool(top), "y", false)}}};
}

json cell_setup(const World& world) {
  json setup = nullptr;
  with_cell_of(world, [&](const auto& cell) {
    setup = {{"corner", cell.corner_now()}, {"vectors", json::array()}};
    for (std::size_t k = 0; k < cell.vectors.n; ++k)
      setup["vectors"].push_back(cell.vectors.column(k));
  });
  return setup;
}

}  // namespace pulvis
