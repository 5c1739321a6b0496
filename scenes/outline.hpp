// Geometry of the particle outlines, apart from any mesh.
#pragma once

#include "scenes/scene.hpp"

namespace pulvis {

// All points within `radius` of a box about the origin, with the outline's own axes. Every outline fills
// one, up to holes: a disc has a box without size, a rectangle no radius.
struct RoundedBox {
  Vec2 half;  // m, half sizes of the box
  double radius;
};
RoundedBox rounded_box(const Outline& outline);

double outline_area(const Outline& outline);  // m^2, of the material inside

}  // namespace pulvis
