// Moves of two and three dimensions whose drive gives: the tool follows its far end as a mass on a spring.
#pragma once

#include <cmath>

#include "components/servo.hpp"
#include "components/shape.hpp"

namespace pulvis {

// `move`: has a stiffness. `direction`: unit vector of its displacement.
template <class Move>
ToolServos::Servo elastic_drive(const Move& move, int stage, const Point3& direction) {
  return {.tool = move.tool,
          .stage = stage,
          .direction = direction,
          .mass = *move.mass,
          .damping = 2 * move.damping * std::sqrt(*move.stiffness * *move.mass),
          .stiffness = *move.stiffness};
}

}  // namespace pulvis
