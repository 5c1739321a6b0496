#include "scenes/tools/die_room.hpp"

#include <algorithm>
#include <cmath>

#include "scenes/tools/constraints.hpp"

namespace pulvis {
namespace {

constexpr double along_axis = 1 - 1e-12;  // cosine between a tool's normal and an axis
constexpr int nobody = -1;

// m^3, between the plane through `point` and the face: integral of 2 pi r h(r), linear between the points.
double volume_of_face(const ToolSpec& punch) {
  double sum = 0;
  for (std::size_t i = 1; i < punch.profile.size(); ++i) {
    const double a = punch.profile[i - 1].x(), b = punch.profile[i].x();
    const double h = punch.profile[i - 1].y(), k = punch.profile[i].y();
    sum += std::numbers::pi / 3 * (b - a) * (h * (2 * a + b) + k * (a + 2 * b));
  }
  return sum;
}

// Assigns a tool to the side from which its normal points inwards.
bool stand_on(DieRoom& room, DieRoom::Side low, const Vec3& axis, const ToolSpec& tool,
              int number) {
  const double cosine = tool.normal.dot(axis);
  if (std::abs(cosine) < along_axis) return false;
  int& side = room.tool[static_cast<std::size_t>(cosine > 0 ? low : low + 1)];
  if (side != nobody) return false;
  side = number;
  return true;
}

std::optional<DieRoom> box_of(const Scene& scene) {
  DieRoom room;
  room.tool.fill(nobody);
  for (std::size_t t = 0; t < scene.tools.size(); ++t) {
    const ToolSpec& tool = scene.tools[t];
    const int number = static_cast<int>(t);
    if (is_constraint(tool)) continue;
    if (tool.shape != ToolSpec::Shape::plane) return std::nullopt;
    if (!stand_on(room, DieRoom::left, Vec3::UnitX(), tool, number) &&
        !stand_on(room, DieRoom::front, Vec3::UnitY(), tool, number) &&
        !stand_on(room, DieRoom::bottom, Vec3::UnitZ(), tool, number))
      return std::nullopt;
  }
  if (std::ranges::find(room.tool, nobody) != room.tool.end()) return std::nullopt;
  return room;
}

std::optional<DieRoom> round_of(const Scene& scene) {
  DieRoom room{.kind = DieRoom::Kind::round};
  room.tool.fill(nobody);
  const auto die = std::ranges::find(scene.tools, ToolSpec::Shape::die, &ToolSpec::shape);
  if (die == scene.tools.end()) return std::nullopt;
  room.die = static_cast<int>(die - scene.tools.begin());
  room.axis = {die->normal.x(), die->normal.y(), die->normal.z()};
  room.diameter = die->diameter;
  room.mouth = die->height;
  for (std::size_t t = 0; t < scene.tools.size(); ++t) {
    const ToolSpec& tool = scene.tools[t];
    if (static_cast<int>(t) == room.die || is_constraint(tool)) continue;
    if (!has_face(tool) || !stand_on(room, DieRoom::bottom, die->normal, tool, static_cast<int>(t)))
      return std::nullopt;
    room.in_faces += volume_of_face(tool);
  }
  if (room.tool[DieRoom::bottom] == nobody || room.tool[DieRoom::top] == nobody)
    return std::nullopt;
  return room;
}

}  // namespace

std::optional<DieRoom> die_room(const Scene& scene) {
  if (auto box = box_of(scene)) return box;
  return round_of(scene);
}

}  // namespace pulvis
