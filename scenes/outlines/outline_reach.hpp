// How far an outline reaches from its origin.
#pragma once

#include <optional>
#include <vector>

#include "scenes/outlines/outline.hpp"

namespace pulvis {

class OutlineReach {
 public:
  explicit OutlineReach(const Outline& outline);
  // m, of the turned outline (rad) in a direction of space (a unit vector).
  double along(double angle, const Vec2& direction) const;

 private:
  std::optional<RoundedBox> box_;
  std::vector<Vec2> polygon_;  // m, of an outline that is none
};

}  // namespace pulvis
