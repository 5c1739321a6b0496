// tool_servo: how fast tools that hold a force move in the next step, from the force that they bear now.
//
// Source   systems/servo_kernel.hpp
// Runs     after tool_reaction; tool_motion adds the way in the next step
// Active   when a stage of the scene has a servo
// Watches  that the force is held when its stage ends
#include <fmt/format.h>

#include <cmath>

#include "components/servo.hpp"
#include "engine/access.hpp"
#include "systems/run_failure.hpp"
#include "systems/servo_kernel.hpp"
#include "systems/systems.hpp"
#include "systems/tool_kernel.hpp"

namespace pulvis {
namespace {

using Servo = ToolServos::Servo;

// What the tool bears against the way it pushes.
double borne(const Servo& servo, const Read<ToolForce>& force) {
  const Row<Tool> tool(servo.tool);
  return -(force(tool, 0) * servo.direction[0] + force(tool, 1) * servo.direction[1]);
}

const Servo* servo_of(const ToolServos& servos, int tool, std::size_t stage) {
  for (const Servo& servo : servos.servos)
    if (servo.tool == tool && static_cast<std::size_t>(servo.stage) == stage) return &servo;
  return nullptr;
}

[[noreturn]] void stop(const Servo& servo, const ToolProgram& program, const Clock& clock,
                       double force) {
  throw RunFailure(fmt::format(
      "tool_servo: '{}' bears {:.6g} N at the end of stage '{}', step {}, t = {:.6g} s; asked for "
      "{:.6g} N, allowed: within {:g} of it (stage.servo.tolerance); a longer stage, a higher "
      "fastest or a powder that bears more would reach it",
      program.names[static_cast<std::size_t>(servo.tool)], force,
      program.stages[static_cast<std::size_t>(servo.stage)].name, clock.step, clock.time,
      servo.force, servo.tolerance));
}

}  // namespace

void tool_servo(Read<Clock> clock, Read<ToolProgram> program, Read<ToolForce> force,
                Write<ToolServos> servos, Write<ServoMomentum> momentum,
                Write<ServoVelocity> velocity, Write<ServoForce> asked) {
  const std::size_t stage = program->stage_at(clock->time);
  const bool new_stage = stage != servos->stage;
  for (int t = 0; t < force.rows(); ++t) {
    const Row<Tool> tool(t);
    const Servo* servo = servo_of(*servos, t, stage);
    if (new_stage) {
      const Servo* last = servo_of(*servos, t, servos->stage);
      if (last != nullptr &&
          !(std::abs(borne(*last, force) - last->force) <= last->tolerance * std::abs(last->force)))
        stop(*last, *program, *clock, borne(*last, force));
      if (servo != nullptr) asked(tool, 1) = borne(*servo, force);
      if (last == nullptr || servo == nullptr) momentum(tool) = 0;
    }
    velocity(tool, 0) = velocity(tool, 1) = 0;
    if (servo == nullptr) continue;
    const double since = clock->time - program->stages[stage].begin;
    const double rise =
        servo->rate > 0 ? std::abs(servo->force - asked(tool, 1)) / servo->rate : servo->rise;
    const double share = since < rise ? kernels::ramp_speed(since / rise) : 1;
    asked(tool, 0) = asked(tool, 1) + share * (servo->force - asked(tool, 1));
    const auto next = kernels::servo_step(momentum(tool), asked(tool, 0) - borne(*servo, force),
                                          servo->mass, servo->damping, servo->fastest, clock->dt);
    momentum(tool) = next.momentum;
    for (int k = 0; k < 2; ++k)
      velocity(tool, k) = next.velocity * servo->direction[static_cast<std::size_t>(k)];
  }
  servos->stage = stage;
}

}  // namespace pulvis
