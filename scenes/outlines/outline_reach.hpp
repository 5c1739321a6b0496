// How far an outline extends from its origin.
#pragma once

#include <optional>
#include <vector>

#include "scenes/outlines/outline.hpp"

namespace pulvis {

class OutlineReach {
 public:
  explicit OutlineReach(const Outline& outline);
  // m, of the rotated outline (rad) in a spatial direction (a unit vector).
  double along(double angle, const Vec2& direction) const;

 private:
  std::optional<RoundedBox> box_;
  std::vector<Vec2> polygon_;  // m, for an outline that is not a rounded box
};

}  // namespace pulvis
