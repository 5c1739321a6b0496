// Positions of the tools and forces on them.
#include <algorithm>

#include "components/servo.hpp"
#include "scenes/results/observables/enclosure.hpp"
#include "scenes/results/observables/result_rows.hpp"
#include "scenes/spec/space_scene.hpp"

namespace pulvis {
namespace {

bool is_servo_driven(const Scene& scene, int tool) {
  const auto drives = [tool](const auto& servo) { return servo.tool == tool; };
  if (scene.space)
    return std::ranges::any_of(scene.space->servos, [&](const auto& servos) {
      return std::ranges::any_of(servos, drives);
    });
  return std::ranges::any_of(scene.stages, [&](const StageSpec& stage) {
    return std::ranges::any_of(stage.servos, drives);
  });
}

bool is_driven_through_a_spring(const Scene& scene, int tool) {
  const auto drives = [tool](const auto& move) { return move.tool == tool && move.stiffness; };
  if (scene.space)
    return std::ranges::any_of(
        scene.space->moves, [&](const auto& moves) { return std::ranges::any_of(moves, drives); });
  return std::ranges::any_of(scene.stages, [&](const StageSpec& stage) {
    return std::ranges::any_of(stage.moves, drives);
  });
}

// What differs between the tools of two and three dimensions.
struct ToolWords {
  std::string name;
  const char* position;  // of which point
  bool radial = false;   // a constraint on displacements along its radius
};

ToolWords words_of(const ToolSpec& tool) {
  const bool constraint = tool.shape == ToolSpec::Shape::constraint;
  if (constraint && tool.holds == ToolSpec::Holds::radial)
    return {tool.name, "x: position of its centre plus the radial displacement of its nodes", true};
  if (tool.radius) return {tool.name, "of the centre of its circle, which moves with its nodes"};
  if (constraint) return {tool.name, "of the centre of its box, which moves with its nodes"};
  return {tool.name, "of a point on the tool's surface"};
}

ToolWords words_of(const space::ToolSpec& tool) {
  using Shape = space::ToolSpec::Shape;
  if (tool.shape == Shape::die) return {tool.name, "of a point on its axis"};
  if (tool.shape == Shape::plane) return {tool.name, "of a point on its surface"};
  if (tool.shape == Shape::punch) return {tool.name, "of the centre of its face"};
  return {tool.name, "of the origin of its file"};
}

void add_tool(const Scene& scene, int tool, const ToolWords& words, Observables& all) {
  const std::string name = "tool/" + words.name + "/", of = " of " + words.name;
  const std::string on = "force on " + words.name;
  const auto position = [tool](int axis) {
    return [tool, axis](const Observation& now) { return tool_position(now.world, tool, axis); };
  };
  const auto force = [tool](int axis) {
    return [tool, axis](const Observation& now) { return tool_force(now.world, tool, axis); };
  };
  const auto of_drive = [tool](const Observation& now) {
    return now.world.column<ServoForce>().values()[2 * tool];
  };
  const char* on_it = "force of the particles on the tool";
  const bool space = scene.space != nullptr, servo = is_servo_driven(scene, tool);
  all.add({{name + "position_x", "m", "position" + of + " $x$", words.position, position(0)},
           {name + "position_y", "m", "position" + of + " $y$", words.position, position(1)},
           {name + "position_z", "m", "position" + of + " $z$", words.position, position(2), space},
           {name + "force_x", "N", on + " $F_x$",
            words.radial ? "radial force of the particles on the tool" : on_it, force(0)},
           {name + "force_y", "N", on + " $F_y$", on_it, force(1)},
           {name + "force_z", "N", on + " $F_z$", on_it, force(2), space},
           {name + "force_asked", "N", "target force" + of + " $F$",
            "force that its servo is to hold at this time, in the direction it pushes", of_drive,
            servo},
           {name + "drive_force", "N", "force of the drive" + of + " $F$",
            "force of its drive's spring and dashpot on it, along its move", of_drive,
            !servo && is_driven_through_a_spring(scene, tool)}});
}

}  // namespace

void add_tool_series(const Scene& scene, Observables& all) {
  int number = 0;
  const auto add = [&](const auto& tools) {
    for (const auto& tool : tools) add_tool(scene, number++, words_of(tool), all);
  };
  if (scene.space)
    add(scene.space->tools);
  else
    add(scene.tools);
}

}  // namespace pulvis
