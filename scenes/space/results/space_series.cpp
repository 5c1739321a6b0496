#include "scenes/space/results/space_series.hpp"

#include <algorithm>
#include <string>

#include "scenes/space/tools/die_room.hpp"
#include "scenes/spec/space_scene.hpp"
#include "scenes/spec/yield.hpp"

namespace pulvis::space {
namespace {

void add_tool_series(const Scene& scene, int number, std::vector<SeriesInfo>& all) {
  const ToolSpec& tool = scene.space->tools[static_cast<std::size_t>(number)];
  const std::string name = "tool/" + tool.name + "/";
  const char* place = tool.shape == ToolSpec::Shape::die     ? "of a point on its axis"
                      : tool.shape == ToolSpec::Shape::plane ? "of a point on its surface"
                      : tool.shape == ToolSpec::Shape::punch ? "of the centre of its face"
                                                             : "of the origin of its file";
  for (const char* axis : {"x", "y", "z"}) all.push_back({name + "position_" + axis, "m", place});
  for (const char* axis : {"x", "y", "z"})
    all.push_back({name + "force_" + axis, "N", "force of the particles on the tool"});
  if (is_servo_driven(scene, number))
    all.push_back({name + "force_asked", "N",
                   "force that its servo is to hold at this time, in the direction it pushes"});
  else if (is_driven_through_a_spring(scene, number))
    all.push_back({name + "drive_force", "N",
                   "force of its drive's spring and dashpot on it, along its move"});
}

void add_room_series(const Scene& scene, const DieRoom& room, std::vector<SeriesInfo>& all) {
  const bool box = room.kind == DieRoom::Kind::box;
  all.push_back({"relative_density", "-",
                 "undeformed particle volume / volume between the tools; NaN if one is beyond the "
                 "mouth of the die"});
  if (common_yield_stress(scene)) {
    all.push_back({"stress_ratio/axial", "-", "mean of top and bottom stress / yield stress"});
    all.push_back({"stress_ratio/lateral", "-",
                   box ? "mean of the stresses on the four walls / yield stress"
                       : "stress on the wall of the die / yield stress"});
  }
  all.push_back({"stress/axial_top", "Pa",
                 "on the top tool: force / cross-section of the die; compression > 0"});
  all.push_back({"stress/axial_bottom", "Pa", "on the bottom tool, defined likewise"});
  if (box)
    for (const char* side : {"left", "right", "front", "back"})
      all.push_back({std::string("stress/radial_") + side, "Pa",
                     "on this wall: force / area between the other tools"});
  else
    all.push_back({"stress/radial", "Pa",
                   "on the wall of the die: normal force / area between the other tools"});
  all.push_back(
      {"stress/transmission", "-",
       "axial force on the bottom tool / on the top tool; NaN where the top carries none"});
}

}  // namespace

bool is_servo_driven(const Scene& scene, int tool) {
  return std::ranges::any_of(scene.space->servos, [&](const std::vector<ServoSpec>& servos) {
    return std::ranges::find(servos, tool, &ServoSpec::tool) != servos.end();
  });
}

bool is_driven_through_a_spring(const Scene& scene, int tool) {
  return std::ranges::any_of(scene.space->moves, [&](const std::vector<MoveSpec>& moves) {
    return std::ranges::any_of(
        moves, [&](const MoveSpec& move) { return move.tool == tool && move.stiffness; });
  });
}

std::vector<SeriesInfo> tool_series(const Scene& scene) {
  std::vector<SeriesInfo> all;
  for (std::size_t t = 0; t < scene.space->tools.size(); ++t)
    add_tool_series(scene, static_cast<int>(t), all);
  if (const auto room = die_room(scene)) add_room_series(scene, *room, all);
  return all;
}

std::vector<SeriesInfo> contact_series() {
  return {{"contacts", "-", "faces in contact with another particle or a tool"},
          {"penetration", "-", "deepest so far, relative to the size of a face"},
          {"narrow_contacts", "-",
           "share of the contact force carried by contacts narrower than two faces"}};
}

std::vector<SeriesInfo> momentum_series() {
  std::vector<SeriesInfo> all;
  for (const char* axis : {"x", "y", "z"})
    all.push_back({std::string("momentum/") + axis, "kg m/s", "of all nodes"});
  for (const char* axis : {"x", "y", "z"})
    all.push_back(
        {std::string("momentum/angular_") + axis, "kg m^2/s", "of all nodes, about the origin"});
  return all;
}

}  // namespace pulvis::space
