#include "cli/session/end_forecast.hpp"

#include <algorithm>
#include <cmath>

#include "components/contact.hpp"
#include "engine/entry.hpp"

namespace pulvis {
namespace {

double displacement(const World& world, const StageEnds& ends, int tool) {
  const double* position = world.column<ToolPosition>().values() + tool_axes * tool;
  const Point3& begin = entry(ends.tools_at_begin, tool);
  double squares = 0;
  for (int k = 0; k < tool_axes; ++k) {
    const double moved = position[k] - entry(begin, k);
    squares += moved * moved;
  }
  return std::sqrt(squares);
}

}  // namespace

double EndForecast::sample(const World& world, const Clock& clock, double relative_density) {
  if (!world.has<StageEnds>()) return clock.end;
  const StageEnds& ends = world.resource<StageEnds>();
  const ToolProgram& program = world.resource<ToolProgram>();
  const std::size_t stage = program.stage_at(clock.time);
  if (stage != stage_) samples_.clear();
  stage_ = stage;
  if (stage != ends.stage) return clock.end;  // it begins with the next step
  for (const StageEnds::End& end : ends.ends) {
    if (static_cast<std::size_t>(end.stage) != stage || end.reached ||
        end.kind == StageEnds::Kind::force)
      continue;
    const bool is_density = end.kind == StageEnds::Kind::density;
    samples_.push_back(
        {clock.time, is_density ? 1 / relative_density : displacement(world, ends, end.tool)});
    if (samples_.size() > samples_used) samples_.pop_front();
    if (samples_.size() < fewest_samples) return clock.end;
    const double over = program.stages[stage].end;
    const double rest =
        time_at(is_density ? 1 / end.value : end.value, samples_.front(), samples_.back());
    return clock.end - over + std::clamp(rest, clock.time, over);
  }
  return clock.end;
}

}  // namespace pulvis
