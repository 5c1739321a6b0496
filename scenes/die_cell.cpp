#include "scenes/die_sides.hpp"
#include "scenes/results.hpp"
#include "scenes/surface.hpp"

namespace pulvis {
namespace {

bool is_profile(const ToolSpec& tool) {
  return tool.shape == ToolSpec::Shape::profile || tool.relief.made;
}

}  // namespace

std::optional<DieCell> die_cell(const Scene& scene) {
  DieCell cell{-1, -1, -1, -1};
  for (std::size_t t = 0; t < scene.tools.size(); ++t) {
    const ToolSpec& tool = scene.tools[t];
    if (tool.shape == ToolSpec::Shape::grip) continue;
    if (tool.shape != ToolSpec::Shape::plane && !is_profile(tool))
      return std::nullopt;  // takes space of its own
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

Relief relief_below(const Scene& scene, const DieCell& cell) {
  const ToolSpec& tool = scene.tools[static_cast<std::size_t>(cell.bottom)];
  Relief relief;
  if (!is_profile(tool)) return relief;
  double volume = 0;
  for (const Vec2& p : drawn_points(make_surface(tool.points, tool.rounding))) {
    if (!relief.x.empty()) volume += 0.5 * (relief.y.back() + p.y()) * (p.x() - relief.x.back());
    relief.x.push_back(p.x());
    relief.y.push_back(p.y());
    relief.volume.push_back(volume);
  }
  return relief;
}

}  // namespace pulvis
