#include "cli/python/module/tool_drive.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "cli/python/module/limits.hpp"
#include "cli/python/module/python_run.hpp"
#include "components/run_state.hpp"
#include "components/servo.hpp"
#include "scenes/language/problem.hpp"
#include "systems/tools/systems.hpp"

namespace pulvis::python {
namespace {

constexpr double seen_in_a_step = 0.25;  // -, of the thinnest part, as in advance_clock

void require_free(const World& world, int tool, const std::string& name) {
  if (!world.has<ToolServos>()) return;
  for (const ToolServos::Servo& servo : world.resource<ToolServos>().servos)
    if (servo.tool == tool)
      throw NotNow(fmt::format(
          "tool {}: a servo or a compliant drive moves it in stage '{}', allowed: tools that the "
          "scene moves by prescribed displacements, or not at all; for the force of a servo: "
          "sim.servos[name].drive(force)",
          name,
          world.resource<ToolProgram>().stages.at(static_cast<std::size_t>(servo.stage)).name));
}

void require_velocity(const Scene& scene, const std::string& name, const Point3& velocity) {
  schema::KeyInfo limits = declared_key(scene, "body", "velocity");
  limits.kind = schema::Kind::quantity;
  for (const double v : velocity)
    if (const std::string fault = fault_of(v, limits); !fault.empty())
      throw OutOfRange(fmt::format("tool {}: velocity: {}", name, fault));
}

void require_seen(const World& world, const std::string& name, const Point3& velocity) {
  const double speed = std::hypot(velocity[0], velocity[1], velocity[2]);
  if (!world.has<ContactRules>()) return;
  const double fastest =
      seen_in_a_step * world.resource<ContactRules>().thinnest / world.resource<Clock>().dt;
  if (speed > fastest)
    throw OutOfRange(
        fmt::format("tool {}: {:.6g} m/s, allowed: <= {:.6g} m/s, otherwise contacts could be "
                    "missed within a step",
                    name, speed, fastest));
}

int index_of(Simulation& simulation, const std::string& name) {
  const std::vector<std::string> names = tool_names(simulation);
  const auto found = std::ranges::find(names, name);
  if (found == names.end())
    throw NotNow(fmt::format("there is no tool '{}'{}, allowed: {}", name, suggestion(name, names),
                             listed(names)));
  return static_cast<int>(found - names.begin());
}

// The servo of the current stage, else the first one; nullptr if no stage has a force servo.
const ToolServos::Servo* servo_of_tool(const World& world, int tool, std::size_t stage) {
  if (!world.has<ToolServos>()) return nullptr;
  const ToolServos::Servo* found = nullptr;
  for (const ToolServos::Servo& servo : world.resource<ToolServos>().servos) {
    if (servo.tool != tool || !servo.holds_force()) continue;
    if (static_cast<std::size_t>(servo.stage) == stage) return &servo;
    if (found == nullptr) found = &servo;
  }
  return found;
}

const ToolServos::Servo& require_servo(Simulation& simulation, const std::string& name) {
  const std::size_t stage =
      simulation.world().resource<ToolProgram>().stage_at(simulation.clock().time);
  const auto* servo = servo_of_tool(simulation.world(), index_of(simulation, name), stage);
  if (servo != nullptr) return *servo;
  const std::vector<std::string> with_servo = servo_names(simulation);
  throw NotNow(fmt::format("tool {}: no stage has a servo that holds its force, allowed: {}", name,
                           with_servo.empty() ? "none in this scene" : listed(with_servo)));
}

}  // namespace

std::vector<std::string> tool_names(Simulation& simulation) {
  World& world = simulation.world();
  return world.has<ToolProgram>() ? world.resource<ToolProgram>().names
                                  : std::vector<std::string>();
}

void drive_tool(Simulation& simulation, const Scene& scene, const std::string& name,
                const Point3& velocity) {
  World& world = simulation.world();
  const int tool = index_of(simulation, name);
  require_free(world, tool, name);
  require_seen(world, name, velocity);
  require_velocity(scene, name, velocity);
  auto& program = world.resource<ToolProgram>();
  const Clock& clock = simulation.clock();
  const Point3 now = tool_position_at(program, tool, clock.time);
  const Point3 before = tool_position_at(program, tool, clock.time - clock.dt_before);
  std::erase_if(program.segments, [&](const auto& segment) { return segment.tool == tool; });
  constexpr int no_stage = -1;  // not cut short by a stage that ends early
  program.start[static_cast<std::size_t>(tool)] = before;
  // Only the two ends of a step are ever evaluated.
  if (clock.dt_before > 0)
    program.segments.push_back(
        {.tool = tool,
         .begin = clock.time - clock.dt_before,
         .duration = clock.dt_before,
         .displacement = {now[0] - before[0], now[1] - before[1], now[2] - before[2]},
         .stage = no_stage});
  // Extends past the end: the last step may be longer than the remaining time.
  const double duration = 2 * (clock.end - clock.time);
  program.segments.push_back(
      {.tool = tool,
       .begin = clock.time,
       .duration = duration,
       .displacement = {velocity[0] * duration, velocity[1] * duration, velocity[2] * duration},
       .stage = no_stage});
}

std::vector<std::string> servo_names(Simulation& simulation) {
  std::vector<std::string> all;
  const std::vector<std::string> names = tool_names(simulation);
  for (std::size_t t = 0; t < names.size(); ++t)
    if (servo_of_tool(simulation.world(), static_cast<int>(t), 0) != nullptr)
      all.push_back(names[t]);
  return all;
}

ServoView servo_view(Simulation& simulation, const std::string& name) {
  World& world = simulation.world();
  const ToolServos::Servo& servo = require_servo(simulation, name);
  const auto stage = world.resource<ToolProgram>().stage_at(simulation.clock().time);
  const bool holds = static_cast<std::size_t>(servo.stage) == stage;
  return {world.column<ServoForce>().values()[2 * servo.tool], servo.direction, holds};
}

void drive_servo(Simulation& simulation, const Scene& scene, const std::string& name,
                 double force) {
  const int tool = require_servo(simulation, name).tool;
  const std::string fault = fault_of(force, declared_key(scene, "stage.servo", "force"));
  if (!fault.empty())
    throw OutOfRange(
        fmt::format("tool {}: force: {}, in the direction in which its servo pushes", name, fault));
  auto& driven = simulation.world().resource<ToolServos>().driven;
  std::erase_if(driven, [&](const auto& one) { return one.tool == tool; });
  driven.push_back({tool, force});
}

}  // namespace pulvis::python
