// Geometry of the particle outlines, apart from any mesh.
#pragma once

#include "scenes/spec/scene.hpp"

#include <optional>
#include <vector>

namespace pulvis {

// All points within `radius` of a box about the origin, with the outline's own axes, up to holes: a disc has
// a box without size, a rectangle no radius.
struct RoundedBox {
  Vec2 half;  // m, half sizes of the box
  double radius;
};
// Empty: the outline is none (an ellipse, superellipse, polygon, points).
std::optional<RoundedBox> rounded_box(const Outline& outline);

// Corners of a polygon inscribed in the outline, counter-clockwise, whose sides leave it by at most
// `deviation` (m, > 0). Of a ring its outer circle.
std::vector<Vec2> outline_polygon(const Outline& outline, double deviation);

bool has_notch(const Outline& outline);  // goes inwards somewhere
// Notched, or so slender that its ends can meet.
bool can_fold(const Outline& outline);

double outline_area(const Outline& outline);  // m^2, of the material inside

}  // namespace pulvis
