#include "scenes/tools/die_relief.hpp"

#include "scenes/tools/surface.hpp"

namespace pulvis {

Relief relief_of(const ToolSurface& surface) {
  Relief relief;
  double volume = 0;
  for (const Vec2& p : drawn_points(surface)) {
    if (!relief.x.empty()) volume += 0.5 * (relief.y.back() + p.y()) * (p.x() - relief.x.back());
    relief.x.push_back(p.x());
    relief.y.push_back(p.y());
    relief.volume.push_back(volume);
  }
  return relief;
}

Relief relief_of(const World& world, int tool) {
  if (!world.has<ToolShapes>()) return {};
  const ToolShapes& shapes = world.resource<ToolShapes>();
  return shapes.is(tool, ToolShapes::Kind::polyline) ? relief_of(shapes.surface_of(tool))
                                                     : Relief{};
}

}  // namespace pulvis
