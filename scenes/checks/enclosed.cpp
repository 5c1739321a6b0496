#include "scenes/checks/enclosed.hpp"

#include <algorithm>
#include <map>

#include "scenes/packing/particle_size.hpp"
#include "scenes/tools/die_room.hpp"
#include "scenes/tools/die_sides.hpp"

namespace pulvis {
namespace {

std::optional<Enclosed> enclosed_area(const Scene& scene) {
  if (scene.cell) return std::nullopt;
  for (const ToolSpec& tool : scene.tools)
    if (tool.shape != ToolSpec::Shape::plane && tool.shape != ToolSpec::Shape::constraint)
      return std::nullopt;
  const auto sides = die_sides(scene);
  if (!sides) return std::nullopt;
  return [sides](const Places& places) {
    const auto at = [&](std::size_t side) {
      return places[static_cast<std::size_t>((*sides)[side])];
    };
    const double width = at(1).x() - at(0).x(), height = at(3).y() - at(2).y();
    return width > 0 && height > 0 ? width * height : 0.0;
  };
}

std::optional<Enclosed> enclosed_volume(const Scene& scene) {
  const auto room = die_room(scene);
  if (!room) return std::nullopt;
  return [room](const Places& places) {
    const auto at = [&](int tool, int k) { return places[static_cast<std::size_t>(tool)][k]; };
    const bool box = room->kind == DieRoom::Kind::box;
    if (!(room->height(at) > 0) || (box && !(room->width(at) > 0 && room->depth(at) > 0)))
      return 0.0;
    return std::max(room->volume(at), 0.0);
  };
}

}  // namespace

std::optional<Enclosed> enclosed(const Scene& scene) {
  if (scene.initial_state) return std::nullopt;
  if (auto volume = enclosed_volume(scene)) return volume;
  return enclosed_area(scene);
}

double content_of_powder(const Scene& scene, const std::vector<BodySpec>& bodies) {
  std::map<int, double> contents;  // of the classes
  double content = 0;
  for (const BodySpec& body : bodies) {
    const auto [of_class, fresh] = contents.try_emplace(body.particle, 0);
    if (fresh) of_class->second = content_of(scene, body);
    content += of_class->second;
  }
  return content;
}

Places tools_at_start(const Scene& scene) {
  Places places;
  for (const ToolSpec& tool : scene.tools) places.push_back(tool.point);
  return places;
}

Places tools_moved(Places places, const std::vector<MoveSpec>& moves, double share) {
  for (const MoveSpec& move : moves)
    places[static_cast<std::size_t>(move.tool)] += share * move.displacement;
  return places;
}

}  // namespace pulvis
