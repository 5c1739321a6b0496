// Positions of the tools and forces on them.
#include "components/servo.hpp"
#include "scenes/results/observables/enclosure.hpp"
#include "scenes/results/observables/result_rows.hpp"
#include "scenes/spec/scene.hpp"
#include "scenes/spec/tool_motion.hpp"

namespace pulvis {
namespace {

struct ToolWords {
  std::string name;
  const char* position;  // of which point
  bool radial = false;   // a constraint on displacements along its radius
};

ToolWords words_of(const Scene& scene, const ToolSpec& tool) {
  using Shape = ToolSpec::Shape;
  const bool constraint = tool.shape == Shape::constraint;
  if (constraint && tool.holds == ToolSpec::Holds::radial)
    return {tool.name, "x: position of its centre plus the radial displacement of its nodes", true};
  if (tool.radius)
    return {tool.name, scene.in_space()
                           ? "of the centre of its sphere, which moves with its nodes"
                           : "of the centre of its circle, which moves with its nodes"};
  if (constraint) return {tool.name, "of the centre of its box, which moves with its nodes"};
  if (tool.shape == Shape::die) return {tool.name, "of a point on its axis"};
  if (tool.shape == Shape::punch) return {tool.name, "of the centre of its face"};
  if (tool.shape == Shape::stl) return {tool.name, "of the origin of its file"};
  return {tool.name, "of a point on the tool's surface"};
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
  const bool space = scene.in_space(), servo = is_servo_driven(scene, tool);
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
  for (std::size_t t = 0; t < scene.tools.size(); ++t)
    add_tool(scene, static_cast<int>(t), words_of(scene, scene.tools[t]), all);
}

}  // namespace pulvis
