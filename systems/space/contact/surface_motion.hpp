// How fast two surfaces may move against each other (SurfaceMotion).
#pragma once

#include <cmath>

#include "components/space/contact.hpp"

namespace pulvis::space {

// m/s, of any point of one surface against any of the other, at most.
inline double relative_speed(const Read<SurfaceMotion>& of, int slot, int other) {
  const double *a = &of(Row<WholeSurface>(slot)), *b = &of(Row<WholeSurface>(other));
  double square = 0;
  for (int k = 0; k < 3; ++k) square += (a[k] - b[k]) * (a[k] - b[k]);
  return std::sqrt(square) + a[SurfaceMotion::difference] + b[SurfaceMotion::difference];
}

}  // namespace pulvis::space
