// Tool drives in two and three dimensions: servos, moves with a compliant drive, and conditions that end a stage early.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "components/servo.hpp"
#include "components/shape.hpp"
#include "scenes/spec/scene.hpp"
#include "systems/tools/servo_kernel.hpp"

namespace pulvis {

inline Point3 values_of(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

// A move with a compliant drive: the tool follows its far end as a mass on a spring. `move`: has a stiffness.
inline ToolServos::Servo elastic_drive(const MoveSpec& move, int stage) {
  return {.tool = move.tool,
          .stage = stage,
          .direction = values_of(move.displacement.normalized()),
          .mass = *move.mass,
          .damping = 2 * move.damping * std::sqrt(*move.stiffness * *move.mass),
          .stiffness = *move.stiffness};
}

inline void add_elastic_drives(const std::vector<StageSpec>& stages, ToolServos& servos) {
  for (std::size_t s = 0; s < stages.size(); ++s)
    for (const MoveSpec& move : stages[s].moves)
      if (move.stiffness) servos.servos.push_back(elastic_drive(move, static_cast<int>(s)));
}

// The powder that a servo pushes against. `wave`: force that a wave into the powder takes from a tool, over its speed.
struct ServoLoad {
  double mass, wave;  // kg, N s/m
};

// `duration`: of the stage, s. `response`: the mass of the tool and of the powder it
// drags, over the powder's. A solid block of the powder's mass, stiffness and cross-section would be critically damped by the
// latter and the dashpot in series.
inline ToolServos::Servo force_servo(const ServoSpec& spec, int stage, double duration,
                                     const Point3& direction, const ServoLoad& powder) {
  const double tool = spec.response / (1 + kernels::dragged_mass);
  return {.tool = spec.tool,
          .stage = stage,
          .direction = direction,
          .force = spec.force,
          .rise = spec.rise * duration,
          .rate = spec.rate.value_or(0),
          .mass = tool * powder.mass,
          .damping = 0.5 * std::sqrt(kernels::dragged_mass * tool) * powder.wave,
          .max_speed = spec.max_speed,
          .tolerance = spec.tolerance,
          .wave = powder.wave,
          .powder_mass = powder.mass};
}

// `direction_of(tool)`: direction from a tool into the powder, zero where its force may point anywhere.
template <class DirectionOf>
std::vector<StageEnds::End> early_ends(const std::vector<StageSpec>& stages,
                                       const DirectionOf& direction_of) {
  std::vector<StageEnds::End> ends;
  for (std::size_t s = 0; s < stages.size(); ++s) {
    if (!stages[s].until) continue;
    const UntilSpec& until = *stages[s].until;
    StageEnds::End end{.stage = static_cast<int>(s)};
    if (until.relative_density) {
      end.kind = StageEnds::Kind::density;
      end.value = *until.relative_density;
    } else {
      end.tool = *until.tool;
      end.kind = until.force ? StageEnds::Kind::force : StageEnds::Kind::displacement;
      end.value = until.force ? *until.force : *until.displacement;
      end.direction = direction_of(end.tool);
    }
    ends.push_back(end);
  }
  return ends;
}

inline bool has_early_ends(const std::vector<StageSpec>& stages) {
  return std::ranges::any_of(stages, [](const StageSpec& s) { return s.until.has_value(); });
}

}  // namespace pulvis
