#include "cli/session/end_forecast.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "components/contact.hpp"
#include "engine/entry.hpp"

namespace pulvis {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();

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

double EndForecast::time_at(double way) const {
  constexpr std::size_t few = 3;
  if (points_.size() < few) return never;
  const Point& from = points_.front();
  const Point& to = points_.back();
  const double slope = (to.way - from.way) / (to.time - from.time);
  const double left = (way - to.way) / slope;
  return std::isfinite(left) && left >= 0 ? to.time + left : never;
}

double EndForecast::sample(const World& world, const Clock& clock, double relative_density) {
  if (!world.has<StageEnds>()) return clock.end;
  constexpr std::size_t kept = 8;
  const StageEnds& ends = world.resource<StageEnds>();
  const ToolProgram& program = world.resource<ToolProgram>();
  const std::size_t stage = program.stage_at(clock.time);
  if (stage != stage_) points_.clear();
  stage_ = stage;
  for (const StageEnds::End& end : ends.ends) {
    if (static_cast<std::size_t>(end.stage) != stage || end.reached ||
        end.kind == StageEnds::Kind::force)
      continue;
    const bool is_density = end.kind == StageEnds::Kind::density;
    points_.push_back(
        {clock.time, is_density ? 1 / relative_density : displacement(world, ends, end.tool)});
    if (points_.size() > kept) points_.pop_front();
    const double over = program.stages[stage].end;
    const double rest = time_at(is_density ? 1 / end.value : end.value);
    return clock.end - over + std::clamp(rest, clock.time, over);
  }
  return clock.end;
}

}  // namespace pulvis
