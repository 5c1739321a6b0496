#include "cli/python/module/tool_drive.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "cli/python/module/python_run.hpp"
#include "components/run_state.hpp"
#include "components/servo.hpp"
#include "scenes/language/problem.hpp"
#include "systems/tools/systems.hpp"

namespace pulvis::python {
namespace {

constexpr double seen_in_a_step = 0.25;  // -, of the thinnest part, as advance_clock has it

void require_free(const World& world, int tool, const std::string& name) {
  if (!world.has<ToolServos>()) return;
  for (const ToolServos::Servo& servo : world.resource<ToolServos>().servos)
    if (servo.tool == tool)
      throw NotNow(fmt::format(
          "tool {}: a servo or a drive that gives moves it in stage '{}', allowed: tools that the "
          "scene moves by set displacements, or not at all",
          name,
          world.resource<ToolProgram>().stages.at(static_cast<std::size_t>(servo.stage)).name));
}

void require_seen(const World& world, const std::string& name, const Point& velocity) {
  const double speed = std::hypot(velocity[0], velocity[1]);
  if (!std::isfinite(speed)) throw NotNow(fmt::format("tool {}: the velocity is not finite", name));
  if (!world.has<ContactRules>()) return;
  const double fastest =
      seen_in_a_step * world.resource<ContactRules>().thinnest / world.resource<Clock>().dt;
  if (speed > fastest)
    throw NotNow(
        fmt::format("tool {}: {:.6g} m/s, allowed: <= {:.6g} m/s, or contacts would be "
                    "passed unseen within a step",
                    name, speed, fastest));
}

}  // namespace

std::vector<std::string> tool_names(Simulation& simulation) {
  World& world = simulation.world();
  return world.has<ToolProgram>() ? world.resource<ToolProgram>().names
                                  : std::vector<std::string>();
}

void drive_tool(Simulation& simulation, const std::string& name, const Point& velocity) {
  World& world = simulation.world();
  const std::vector<std::string> names = tool_names(simulation);
  const auto found = std::ranges::find(names, name);
  if (found == names.end())
    throw NotNow(fmt::format("there is no tool '{}'{}, allowed: {}", name, suggestion(name, names),
                             listed(names)));
  const int tool = static_cast<int>(found - names.begin());
  require_free(world, tool, name);
  require_seen(world, name, velocity);
  auto& program = world.resource<ToolProgram>();
  const Clock& clock = simulation.clock();
  const Point3 now = tool_position_at(program, tool, clock.time);
  const Point3 before = tool_position_at(program, tool, clock.time - clock.dt_before);
  std::erase_if(program.segments, [&](const auto& segment) { return segment.tool == tool; });
  constexpr int no_stage = -1;  // none that ends early cuts it
  program.start[static_cast<std::size_t>(tool)] = before;
  // Within a step nobody asks but for its two ends.
  if (clock.dt_before > 0)
    program.segments.push_back({.tool = tool,
                                .begin = clock.time - clock.dt_before,
                                .duration = clock.dt_before,
                                .displacement = {now[0] - before[0], now[1] - before[1], 0},
                                .stage = no_stage});
  // Beyond the end: the last steps are longer than the time that is left.
  const double duration = 2 * (clock.end - clock.time);
  program.segments.push_back({.tool = tool,
                              .begin = clock.time,
                              .duration = duration,
                              .displacement = {velocity[0] * duration, velocity[1] * duration, 0},
                              .stage = no_stage});
}

}  // namespace pulvis::python
