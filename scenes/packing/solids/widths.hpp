// The width of a particle: the distance between two parallel planes that touch it.
#pragma once

#include "scenes/spec/scene.hpp"

namespace pulvis::space {

struct Widths {
  double least = 0;   // m, minimum over all directions
  double middle = 0;  // m, minimum across that direction: the sieve size
};
// Of its convex hull, for any orientation of the shape in its axes.
Widths widths_of(const ParticleShape& shape);

}  // namespace pulvis::space
