// Geometry of the particle outlines, independent of any mesh.
#pragma once

#include "scenes/spec/scene.hpp"

#include <optional>
#include <vector>

namespace pulvis {

// All points within `radius` of a box about the origin, aligned with the outline's axes, except for holes: a
// disc has a box of zero size, a rectangle a radius of zero.
struct RoundedBox {
  Vec2 half;  // m, half sizes of the box
  double radius;
};
// Empty: not a rounded box (an ellipse, superellipse, polygon, points).
std::optional<RoundedBox> rounded_box(const Outline& outline);

// Corners of a polygon inscribed in the outline, counter-clockwise, whose sides deviate by at most
// `deviation` (m, > 0). For a ring its outer circle.
std::vector<Vec2> outline_polygon(const Outline& outline, double deviation);

bool has_notch(const Outline& outline);  // has a concave part
// Concave, or so slender that its ends can touch.
bool can_fold(const Outline& outline);

double outline_area(const Outline& outline);  // m^2, of the material inside

}  // namespace pulvis
