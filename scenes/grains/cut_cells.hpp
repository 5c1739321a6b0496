// Voronoi cells inside an outline.
#pragma once

#include <cstdint>

#include "scenes/grains/grain_map.hpp"

namespace pulvis {

struct Tessellation {
  int grains = 2;           // requested; there are more where a notch cuts cells in two
  int relaxation = 0;       // steps of Lloyd's method
  double aspect_ratio = 1;  // of the grains, length over width
  double direction = 0;     // rad, of their long axis
  std::uint64_t seed = 1;
};

GrainMap tessellate(const OutlineCurve& outline, const Tessellation& wanted);

}  // namespace pulvis
