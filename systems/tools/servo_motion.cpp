#include <fmt/format.h>

#include <cmath>

#include "components/contact.hpp"
#include "components/servo.hpp"
#include "engine/access.hpp"
#include "engine/entry.hpp"
#include "engine/run_failure.hpp"
#include "systems/tools/servo_kernel.hpp"
#include "systems/tools/servo_motion.hpp"
#include "systems/tools/systems.hpp"
#include "systems/tools/tool_kernel.hpp"

namespace pulvis {
namespace {

using Servo = ToolServos::Servo;

double along(const auto& column, Row<Tool> tool, const Point3& direction) {
  return column(tool, 0) * direction[0] + column(tool, 1) * direction[1] +
         column(tool, 2) * direction[2];
}
void set_along(const auto& column, Row<Tool> tool, const Point3& direction, double value) {
  for (int k = 0; k < tool_axes; ++k) column(tool, k) = value * entry(direction, k);
}

// The force on the tool against its pushing direction.
double load(const Servo& servo, const Read<ToolForce>& force) {
  return -along(force, Row<Tool>(servo.tool), servo.direction);
}

const Servo* servo_of(const ToolServos& servos, int tool, std::size_t stage) {
  for (const Servo& servo : servos.servos)
    if (servo.tool == tool && static_cast<std::size_t>(servo.stage) == stage) return &servo;
  return nullptr;
}

ServoWatch& watch_of(ToolServos& servos, const Servo& servo) {
  return servos.watches[static_cast<std::size_t>(&servo - servos.servos.data())];
}

// `force`: at the end of the stage, N.
void check_held(const Servo& servo, ServoWatch watch, double force, const ToolProgram& program,
                const Clock& clock) {
  if (!servo.holds_force()) return;
  watch.see_error(force - servo.force);
  const double allowed = servo.tolerance * std::abs(servo.force);
  if (watch.lowest >= -allowed && watch.highest <= allowed) return;
  throw RunFailure(fmt::format(
      "tool_servo: '{}' carries {:.6g} N at the end of stage '{}', step {}, t = {:.6g} s; target "
      "{:.6g} N; its force error is {:.6g} to {:.6g} N over the last tenth of the stage, allowed: "
      "within {:g} of the target (stage.servo.tolerance); use {}",
      entry(program.names, servo.tool), force + 0.0 /* not -0 */,
      entry(program.stages, servo.stage).name, clock.step, clock.time, servo.force, watch.lowest,
      watch.highest, servo.tolerance,
      watch.highest < 0 ? "a longer stage, a higher max_speed or a stronger powder"
                        : "a longer stage, or more damping of what oscillates (contact.damping, "
                          "material.damping)"));
}

// Current target: ramped smoothly from the tool's force at the start of the stage.
double asked_for(const Servo& servo, double at_begin, double since) {
  const double rise = servo.rate > 0 ? std::abs(servo.force - at_begin) / servo.rate : servo.rise;
  const double share = since < rise ? kernels::ramp_speed(since / rise) : 1;
  return at_begin + share * (servo.force - at_begin);
}

// Speed of the drive's far end along its direction between two times.
double end_speed(const ToolProgram& program, const Servo& servo, double from, double until) {
  if (!(until > from)) return 0;
  const Point3 a = tool_position_at(program, servo.tool, from);
  const Point3 b = tool_position_at(program, servo.tool, until);
  return ((b[0] - a[0]) * servo.direction[0] + (b[1] - a[1]) * servo.direction[1] +
          (b[2] - a[2]) * servo.direction[2]) /
         (until - from);
}

// The next step of a tool behind a spring; the stored velocity is relative to the drive's far end.
void follow(const Servo& servo, Row<Tool> tool, const Clock& clock, const ToolProgram& program,
            const Servos::Drive& drive, double bears) {
  const double before = end_speed(program, servo, clock.time - clock.dt_before, clock.time);
  const double next = end_speed(program, servo, clock.time, clock.time + clock.dt);
  const double behind = -along(drive.travel, tool, servo.direction);
  const double slower = -along(drive.velocity, tool, servo.direction);
  drive.asked(tool, 0) = servo.stiffness * behind + servo.damping * slower;
  const double speed =
      kernels::elastic_speed({servo.mass, servo.stiffness, servo.damping}, before - slower, behind,
                             next, bears, 0.5 * (clock.dt_before + clock.dt));
  set_along(drive.velocity, tool, servo.direction, speed - next);
}

void check_mass(const Servo& servo, const ToolProgram& program, const Clock& clock, double needed) {
  if (servo.mass >= needed) return;
  throw RunFailure(fmt::format(
      "tool_servo: the mass of '{}' behind its drive is {:.4g} kg, step {}, t = {:.6g} s; allowed: "
      "at least {:.4g} kg with what touches it, or a smaller time step",
      entry(program.names, servo.tool), servo.mass, clock.step, clock.time, needed));
}

kernels::ServoPowder powder_of(const Servo& servo) { return {servo.powder_mass, servo.wave}; }

// The forces that count while the servo is on its way: `asked(tool, 1)` is that at the start of the stage.
kernels::ServoAim aim_of(const Servo& servo, const ToolServos::Driven* driven, double at_begin) {
  const double target = driven != nullptr ? driven->force : servo.force;
  const double scale = std::max(std::abs(target), std::abs(at_begin));
  return {target, scale, std::min(servo.tolerance, kernels::reached) * scale};
}

class ForceServo {
 public:
  ForceServo(const Servos& s, const Servo& servo, Row<Tool> tool)
      : s_(s),
        servo_(servo),
        tool_(tool),
        bears_(load(servo, s.force)),
        response_(entry(s.servos->responses, servo.tool)),
        watch_(watch_of(*s.servos, servo)) {}

  void begin_stage(bool had_servo) {
    s_.drive.asked(tool_, 1) = bears_;
    watch_ = {.overshoot = watch_.overshoot};
    if (had_servo) return;
    s_.drive.mass(tool_) = servo_.mass;
    response_ = {.force = bears_};
  }

  void drive(const ToolProgram::Stage& stage, const kernels::TouchSums& touching) {
    const Clock& clock = *s_.clock;
    const ToolServos::Driven* driven = s_.servos->driven_force(servo_.tool);
    const double at_begin = s_.drive.asked(tool_, 1);
    const double asked =
        driven != nullptr ? driven->force : asked_for(servo_, at_begin, clock.time - stage.begin);
    const kernels::ServoAim aim = aim_of(servo_, driven, at_begin);
    s_.drive.asked(tool_, 0) = asked;
    if (driven == nullptr) watch_.see_force(bears_, aim.scale);
    if (is_judged(stage, clock.time)) watch_.see_error(bears_ - asked);
    move(asked, aim, touching);
  }

 private:
  void move(double asked, const kernels::ServoAim& aim, const kernels::TouchSums& touching) {
    const Clock& clock = *s_.clock;
    const double minimum = kernels::min_tool_mass(touching, clock.dt, clock.safety);
    const kernels::ServoState last{s_.drive.mass(tool_),
                                   along(s_.drive.velocity, tool_, servo_.direction),
                                   along(s_.drive.dragged, tool_, servo_.direction)};
    response_ = kernels::with_step(response_, bears_, last.speed * clock.dt_before, clock.dt_before,
                                   powder_of(servo_));
    const kernels::ServoState now = kernels::with_mass(last, std::max(servo_.mass, minimum));
    const kernels::ServoState next =
        kernels::servo_step(now, asked - bears_, servo_.damping * std::sqrt(now.mass / servo_.mass),
                            kernels::speed_limits(response_, bears_, aim, now.mass,
                                                  servo_.max_speed, powder_of(servo_)),
                            0.5 * (clock.dt_before + clock.dt));
    s_.drive.mass(tool_) = next.mass;
    set_along(s_.drive.velocity, tool_, servo_.direction, next.speed);
    set_along(s_.drive.dragged, tool_, servo_.direction, next.dragged);
  }

  const Servos& s_;
  const Servo& servo_;
  Row<Tool> tool_;
  double bears_;
  ServoResponse& response_;
  ServoWatch& watch_;
};

}  // namespace

void drive_tools(const Servos& s, const Touching& touching) {
  const auto& [clock, program, ends, force, rules, servos, drive] = s;
  const std::size_t stage = program->stage_at(clock->time);
  const bool new_stage = stage != servos->stage;
  // A stage cut short by [stage.until] ended before the full force was requested.
  const bool ended_early = ends && (*ends)->has_ended_early(servos->stage);
  for (int t = 0; t < force.rows(); ++t) {
    const Row<Tool> tool(t);
    const Servo* servo = servo_of(*servos, t, stage);
    const Servo* last = servo_of(*servos, t, servos->stage);
    if (new_stage && last != nullptr && servos->driven_force(t) == nullptr && !ended_early)
      check_held(*last, watch_of(*servos, *last), load(*last, force), *program, *clock);
    if (servo == nullptr) {
      set_along(drive.velocity, tool, {}, 0), set_along(drive.dragged, tool, {}, 0);
      // It has no target any more; at the very end of the run it still does.
      if (last != nullptr && stage < program->stages.size()) drive.asked(tool, 0) = 0;
      continue;
    }
    if (!servo->holds_force()) {
      kernels::TouchSums sums = touching(t);
      sums.stiffness += servo->stiffness;
      check_mass(*servo, *program, *clock, kernels::min_tool_mass(sums, clock->dt, clock->safety));
      follow(*servo, tool, *clock, *program, drive, load(*servo, force));
      continue;
    }
    ForceServo now(s, *servo, tool);
    if (new_stage) now.begin_stage(last != nullptr);
    now.drive(program->stages[stage], touching(t));
  }
  servos->stage = stage;
}

}  // namespace pulvis
