#include "scenes/tools/die_sides.hpp"

#include <cmath>

namespace pulvis {
namespace {

constexpr double straight = 1 - 1e-12;  // cosine between a plane's normal and an axis

}  // namespace

Vec2 face_normal(const ToolSpec& tool) {
  if (tool.shape == ToolSpec::Shape::plane) return in_plane(tool.normal);
  if (tool.points.empty()) return Vec2::UnitY();  // a profile that has not been generated yet
  const Vec2 along = tool.points.back() - tool.points.front();
  return std::abs(along.x()) >= std::abs(along.y()) ? Vec2(0, along.x() > 0 ? 1 : -1)
                                                    : Vec2(along.y() > 0 ? -1 : 1, 0);
}

std::optional<DieSides> die_sides(const Scene& scene) {
  if (scene.in_space()) return std::nullopt;
  constexpr int none = -1;
  DieSides sides{none, none, none, none};
  for (std::size_t t = 0; t < scene.tools.size(); ++t) {
    if (scene.tools[t].shape == ToolSpec::Shape::constraint) continue;
    const Vec2 n = face_normal(scene.tools[t]);
    const std::array<double, 4> along{n.x(), -n.x(), n.y(), -n.y()};
    int side = none;
    for (int s = 0; s < 4; ++s)
      if (along[static_cast<std::size_t>(s)] > straight) side = s;
    if (side == none || sides[static_cast<std::size_t>(side)] != none) return std::nullopt;
    sides[static_cast<std::size_t>(side)] = static_cast<int>(t);
  }
  for (const int tool : sides)
    if (tool == none) return std::nullopt;
  return sides;
}

}  // namespace pulvis
