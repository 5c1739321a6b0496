#include "scenes/tools/die_cell.hpp"

#include <algorithm>

#include "scenes/tools/die_sides.hpp"

namespace pulvis {
namespace {

// A target surface, or a polyline like one: it extends in x, with the powder above.
bool is_ground(const ToolSpec& tool) {
  if (tool.shape == ToolSpec::Shape::profile) return true;
  if (tool.shape != ToolSpec::Shape::polyline || tool.points.empty()) return false;
  return std::ranges::adjacent_find(tool.points, [](const Vec2& a, const Vec2& b) {
           return !(b.x() > a.x());
         }) == tool.points.end();
}

// For a polyline, which continues straight beyond its ends.
bool lies_behind(const ToolSpec& polyline, const ToolSpec& plane) {
  const std::vector<Vec2>& p = polyline.points;
  const Vec2 point = in_plane(plane.point), normal = in_plane(plane.normal);
  const auto height = [&](const Vec2& at) { return (at - point).dot(normal); };
  return std::ranges::all_of(p, [&](const Vec2& at) { return height(at) <= 0; }) &&
         height(p.front()) <= height(p[1]) && height(p.back()) <= height(p[p.size() - 2]);
}

// Platens that stay behind a wall of the die until it is removed.
bool waits_outside(const ToolSpec& tool, const Scene& scene) {
  return tool.shape == ToolSpec::Shape::polyline && tool.points.size() > 1 &&
         std::ranges::any_of(scene.tools, [&](const ToolSpec& wall) {
           return wall.shape == ToolSpec::Shape::plane && !wall.on_packing &&
                  lies_behind(tool, wall);
         });
}

}  // namespace

std::optional<DieCell> die_cell(const Scene& scene) {
  if (scene.in_space()) return std::nullopt;
  DieCell cell{-1, -1, -1, -1};
  for (std::size_t t = 0; t < scene.tools.size(); ++t) {
    const ToolSpec& tool = scene.tools[t];
    if (tool.shape == ToolSpec::Shape::constraint || waits_outside(tool, scene)) continue;
    if (tool.shape != ToolSpec::Shape::plane && !is_ground(tool))
      return std::nullopt;  // takes up space
    const Vec2 n = face_normal(tool);
    int* side = n.x() > 1 - 1e-12    ? &cell.left
                : n.x() < -1 + 1e-12 ? &cell.right
                : n.y() > 1 - 1e-12  ? &cell.bottom
                : n.y() < -1 + 1e-12 ? &cell.top
                                     : nullptr;
    if (side == nullptr || *side >= 0) return std::nullopt;
    *side = static_cast<int>(t);
  }
  if (cell.left < 0 || cell.right < 0 || cell.bottom < 0 || cell.top < 0) return std::nullopt;
  return cell;
}

}  // namespace pulvis
