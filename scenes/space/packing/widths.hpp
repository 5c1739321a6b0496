// How wide a particle is: between two parallel planes that touch it.
#pragma once

#include "scenes/spec/space_scene.hpp"

namespace pulvis::space {

struct Widths {
  double least = 0;   // m, along any direction
  double middle = 0;  // m, the least one across that direction: what passes a sieve
};
// Of its convex hull, however the shape lies in its own axes.
Widths widths_of(const ParticleShape& shape);

}  // namespace pulvis::space
