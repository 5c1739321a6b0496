// stage_control: ends a stage when the condition of its `until` is met. Its tools, or strains, come to rest smoothly, in
// the time they took to start, and all that follows begins earlier.
//
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

Point3 of_tool(const auto& column, Row<Tool> tool) {
  return {column(tool, 0), column(tool, 1), column(tool, 2)};
}
double size_of(const Point3& v) { return portable::hypot(portable::hypot(v[0], v[1]), v[2]); }

double relative_density(const StageEnds::Cell& cell, const Read<ToolPosition>& at) {
  const Row<Tool> bottom(cell.bottom);
  const kernels::DieSides sides{at(Row<Tool>(cell.left), 0), at(Row<Tool>(cell.right), 0),
                                at(Row<Tool>(cell.top), 1), at(bottom, 0), at(bottom, 1)};
  return cell.particle_area / kernels::die_area(sides, cell.relief);
}

// Area strain still to come from the driven strains if they begin to come to rest now: half a ramp at the current
// speed.
double strain_to_rest(const MixedControl& control, const ToolProgram& program, int stage,
                      const Clock& clock) {
  const MixedControl::Stage& asked = entry(control.stages, stage);
  const double since = clock.time - entry(program.stages, stage).begin;
  const double share = 0.5 * asked.ramp * kernels::smooth_speed(since / asked.duration, asked.ramp);
  double strain = 0;
  for (const int k : {MixedControl::xx, MixedControl::yy})
    if (entry(asked.law, k) == MixedControl::Law::strain) strain += entry(asked.strain, k);
  return share * strain;
}

double value_now(const End& end, const stage_control& s) {
  const StageEnds& ends = *s.ends;
  if (end.kind == StageEnds::Kind::density && s.cell)
    return ends.cell.particle_area / (*s.cell)->area() *
           portable::exp(-strain_to_rest((*s.cell)->control, *s.program, end.stage, *s.clock));
  const Read<ToolPosition>& at = s.tools->position;
  const Read<ToolForce>& force = s.tools->force;
  const Row<Tool> tool(end.tool);
  if (end.kind == StageEnds::Kind::density && ends.room)
    return ends.room->density([&](int number, int k) { return at(Row<Tool>(number), k); });
  if (end.kind == StageEnds::Kind::density) return relative_density(ends.cell, at);
  if (end.kind == StageEnds::Kind::displacement) {
    const Point3& from = entry(ends.tools_at_begin, end.tool);
    return size_of({at(tool, 0) - from[0], at(tool, 1) - from[1], at(tool, 2) - from[2]});
  }
  const Point3 borne = of_tool(force, tool);
  const bool any_way = end.direction == Point3{};
  return any_way ? size_of(borne)
                 : -(borne[0] * end.direction[0] + borne[1] * end.direction[1] +
                     borne[2] * end.direction[2]);
}

// A displacement may be the whole of a move, which ends there except for round-off.
bool is_reached(const End& end, double value) {
  constexpr double rounding = 1e-12;
  const bool moved = end.kind == StageEnds::Kind::displacement;
  return value >= (moved ? (1 - rounding) * end.value : end.value);
}

// How long its tools, or strains, take to come to rest; 0 if none is moving.
double time_to_rest(const ToolProgram& program, const MixedControl* control, int stage) {
  double longest = 0;
  if (control != nullptr) {
    const MixedControl::Stage& asked = entry(control->stages, stage);
    for (int k = 0; k < MixedControl::parts; ++k)
      if (entry(asked.law, k) == MixedControl::Law::strain && entry(asked.strain, k) != 0)
        longest = asked.ramp * asked.duration;
  }
  for (const ToolProgram::Segment& s : program.segments)
    if (s.stage == stage) longest = std::max(longest, s.ramp * s.duration);
  return longest;
}

void end_early(const End& end, double time, MixedControl* control, ToolProgram& program,
               double& run_end) {
  ToolProgram::Stage& stage = entry(program.stages, end.stage);
  const double saved = stage.end - (time + time_to_rest(program, control, end.stage));
  if (saved <= 0) return;  // its time is almost over
  if (control != nullptr) control->cut = time;
  stage.end -= saved;
  run_end -= saved;
  for (auto s = static_cast<std::size_t>(end.stage) + 1; s < program.stages.size(); ++s) {
    program.stages[s].begin -= saved;
    program.stages[s].end -= saved;
  }
  for (ToolProgram::Segment& s : program.segments) {
    if (s.stage == end.stage) s.cut = time;
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

void stage_control::operator()() const {
  const std::size_t stage = program->stage_at(clock->time);
  const bool new_stage = stage != ends->stage;
  if (new_stage)
    for (End& end : ends->ends)
      if (static_cast<std::size_t>(end.stage) == ends->stage && !end.reached)
        if (const double value = value_now(end, *this); !is_reached(end, value))
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
    end.reached = is_reached(end, value_now(end, *this));
    if (end.reached) end_early(end, clock->time, control, *program, ends->run_end);
  }
}

}  // namespace pulvis
