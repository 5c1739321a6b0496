// stage_control: ends a stage at the condition of its `until`. Its tools, or strains, come to rest smoothly, in the time
// they took to start, and all that follows begins earlier.
//
// Ends at  a relative density or displacement: they begin to come to rest when what is still to come completes it. A
//          force is not known before: they begin to come to rest where it is reached, and it rises further
// Runs     after tool_reaction, before tool_servo
// Active   when a stage of the scene has an `until`
// Watches  that it is met before the stage's time is over
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "components/servo.hpp"
#include "engine/access.hpp"
#include "engine/entry.hpp"
#include "engine/portable_math.hpp"
#include "engine/run_failure.hpp"
#include "systems/tools/relief_kernel.hpp"
#include "systems/tools/systems.hpp"
#include "systems/tools/tool_kernel.hpp"

namespace pulvis {
namespace {

using End = StageEnds::End;

using Segment = ToolProgram::Segment;

Point3 of_tool(const auto& column, Row<Tool> tool) {
  return {column(tool, 0), column(tool, 1), column(tool, 2)};
}
double size_of(const Point3& v) { return portable::hypot(portable::hypot(v[0], v[1]), v[2]); }

// ---- coming to rest -------------------------------------------------------------------------------
bool is_falling(const Segment& move, double time) {
  return time >= move.begin + (1 - move.ramp) * move.duration;
}

// When its tools and strains are at rest if they begin to come to rest at `time`.
double rest_time(const ToolProgram& program, const MixedControl* control, int stage, double time) {
  double latest = time;
  const auto take = [&](double begin, double duration, double ramp) {
    latest = std::max(latest, std::min(time + ramp * duration, begin + duration));
  };
  if (control != nullptr) {
    const MixedControl::Stage& asked = entry(control->stages, stage);
    for (int k = 0; k < MixedControl::parts; ++k)
      if (entry(asked.law, k) == MixedControl::Law::strain && entry(asked.strain, k) != 0)
        take(entry(program.stages, stage).begin, asked.duration, asked.ramp);
  }
  for (const Segment& s : program.segments)
    if (s.stage == stage) take(s.begin, s.duration, s.ramp);
  return latest;
}

// Strain still to come from a driven component if it begins to come to rest now.
template <class D>
double strain_to_rest(const MixedControl& control, int part, const stage_control<D>& s, int stage) {
  const MixedControl::Stage& asked = entry(control.stages, stage);
  if (entry(asked.law, part) != MixedControl::Law::strain) return 0;
  const double since = s.clock->time - entry(s.program->stages, stage).begin;
  return kernels::travel_to_rest(since / asked.duration, asked.ramp) * entry(asked.strain, part);
}

// The same for the way of a plane that is driven by strains: the two of an axis share their change of distance.
template <class D>
double wall_to_rest(int tool, int k, const stage_control<D>& s, int stage) {
  const DrivenWalls& walls = **s.walls;
  if (k >= D::axes) return 0;
  const auto [low, high] = entry(walls.walls, k);
  if (tool != low && tool != high) return 0;
  const Read<ToolPosition>& at = s.tools->position;
  const double size = at(Row<Tool>(high), k) - at(Row<Tool>(low), k);
  const double half = 0.5 * size * (portable::exp(strain_to_rest(walls.control, k, s, stage)) - 1);
  return tool == high ? half : -half;
}

// The way that a servo adds to its tool until `rest` at the current speed. Behind an elastic drive that speed is of the
// spring, and falls like that of its far end.
template <class D>
double servo_to_rest(int tool, int k, const stage_control<D>& s, int stage) {
  const MixedControl* control = s.walls ? &(*s.walls)->control : nullptr;
  const double left = rest_time(*s.program, control, stage, s.clock->time) - s.clock->time;
  for (const ToolServos::Servo& servo : s.drives->servos->servos)
    if (servo.tool == tool && servo.stage == stage)
      return (servo.holds_force() ? 1 : 0.5) * left * s.drives->velocity(Row<Tool>(tool), k);
  return 0;
}

// m: where a tool will have come to rest.
template <class D>
double rest_position(int tool, int k, const stage_control<D>& s, int stage) {
  double at = s.tools->position(Row<Tool>(tool), k);
  for (const Segment& move : s.program->segments)
    if (move.tool == tool && move.stage == stage)
      at += entry(move.displacement, k) *
            kernels::travel_to_rest((s.clock->time - move.begin) / move.duration, move.ramp);
  if (s.walls) at += wall_to_rest(tool, k, s, stage);
  if (s.drives) at += servo_to_rest(tool, k, s, stage);
  return at;
}

// ---- conditions -----------------------------------------------------------------------------------
template <class D>
double density_at_rest(const stage_control<D>& s, int stage) {
  const StageEnds& ends = *s.ends;
  if (s.cell) {
    const MixedControl& control = (*s.cell)->control;
    double to_come = 0;
    for (int k = 0; k < D::axes; ++k) to_come += strain_to_rest(control, k, s, stage);
    return ends.content / (*s.cell)->size() * portable::exp(-to_come);
  }
  const auto at = [&](int tool, int k) { return rest_position(tool, k, s, stage); };
  if (ends.room) return ends.room->density(at);
  const StageEnds::Cell& cell = ends.cell;
  const kernels::DieSides sides{at(cell.left, 0), at(cell.right, 0), at(cell.top, 1),
                                at(cell.bottom, 0), at(cell.bottom, 1)};
  return ends.content / kernels::die_area(sides, cell.relief);
}

template <class D>
double displacement_at_rest(const stage_control<D>& s, const End& end) {
  Point3 moved = entry(s.ends->tools_at_begin, end.tool);
  for (int k = 0; k < tool_axes; ++k)
    entry(moved, k) = rest_position(end.tool, k, s, end.stage) - entry(moved, k);
  return size_of(moved);
}

template <class D>
double force_now(const stage_control<D>& s, const End& end) {
  const Point3 load = of_tool(s.tools->force, Row<Tool>(end.tool));
  const bool any_way = end.direction == Point3{};
  return any_way ? size_of(load)
                 : -(load[0] * end.direction[0] + load[1] * end.direction[1] +
                     load[2] * end.direction[2]);
}

template <class D>
double value_at_rest(const End& end, const stage_control<D>& s) {
  if (end.kind == StageEnds::Kind::density) return density_at_rest(s, end.stage);
  return end.kind == StageEnds::Kind::displacement ? displacement_at_rest(s, end)
                                                   : force_now(s, end);
}

// A displacement may be the whole of a move, which ends there except for round-off.
bool is_reached(const End& end, double value) {
  constexpr double rounding = 1e-12;
  const bool moved = end.kind == StageEnds::Kind::displacement;
  return value >= (moved ? (1 - rounding) * end.value : end.value);
}

// Moves whose speed falls already end as they would.
void end_early(const End& end, double time, MixedControl* control, ToolProgram& program,
               double& run_end) {
  ToolProgram::Stage& stage = entry(program.stages, end.stage);
  const double rest = rest_time(program, control, end.stage, time);
  const double saved = std::max(stage.end - rest, 0.0);
  if (control != nullptr) {
    const MixedControl::Stage& asked = entry(control->stages, end.stage);
    if (saved > 0 || time < stage.begin + (1 - asked.ramp) * asked.duration) control->cut = time;
  }
  stage.end -= saved;
  run_end -= saved;
  for (auto s = static_cast<std::size_t>(end.stage) + 1; s < program.stages.size(); ++s) {
    program.stages[s].begin -= saved;
    program.stages[s].end -= saved;
  }
  for (Segment& s : program.segments) {
    if (s.stage == end.stage && !is_falling(s, time)) s.cut = time;
    if (s.stage > end.stage) s.begin -= saved;
  }
}

[[noreturn]] void stop(const End& end, const ToolProgram& program, const Clock& clock,
                       double value) {
  const std::string& tool = entry(program.names, end.tool);
  const std::string what = end.kind == StageEnds::Kind::density ? "relative density is"
                           : end.kind == StageEnds::Kind::force
                               ? fmt::format("'{}' carries", tool)
                               : fmt::format("'{}' has moved", tool);
  const char* unit = end.kind == StageEnds::Kind::density ? ""
                     : end.kind == StageEnds::Kind::force ? " N"
                                                          : " m";
  throw RunFailure(
      fmt::format("stage_control: {} {:.6g}{} when the duration of stage '{}' is over, step {}, t "
                  "= {:.6g} s; it was to end at {:.6g}{} (stage.until)",
                  what, value + 0.0 /* not -0 */, unit, entry(program.stages, end.stage).name,
                  clock.step, clock.time, end.value, unit));
}

}  // namespace

template <class D>
void stage_control<D>::operator()() const {
  const std::size_t stage = program->stage_at(clock->time);
  const bool new_stage = stage != ends->stage;
  if (new_stage)
    for (End& end : ends->ends)
      if (static_cast<std::size_t>(end.stage) == ends->stage && !end.reached)
        if (const double value = value_at_rest(end, *this); !is_reached(end, value))
          stop(end, *program, *clock, value);
  if (new_stage && tools) {
    ends->tools_at_begin.resize(static_cast<std::size_t>(tools->position.rows()));
    for (int t = 0; t < tools->position.rows(); ++t)
      entry(ends->tools_at_begin, t) = of_tool(tools->position, Row<Tool>(t));
  }
  ends->stage = stage;
  ends->run_end = std::min(ends->run_end, clock->end);
  MixedControl* control = cell ? &(*cell)->control : walls ? &(*walls)->control : nullptr;
  for (End& end : ends->ends) {
    if (static_cast<std::size_t>(end.stage) != stage || end.reached) continue;
    end.reached = is_reached(end, value_at_rest(end, *this));
    if (end.reached) end_early(end, clock->time, control, *program, ends->run_end);
  }
}
template struct stage_control<TwoD>;
template struct stage_control<ThreeD>;

}  // namespace pulvis
