// [die]: the die cavity, given once. It is copied into the packings and tools before they are read.
#pragma once

#include <optional>

#include "scenes/language/vectors.hpp"

namespace pulvis {

struct DieSpec {
  std::optional<double> width, depth;  // m, along x, y; in two dimensions only the width
  std::optional<double> diameter;      // m, of a round die along z, instead of a box
  std::optional<Vec3> corner;  // m, with the smallest x, y, z; of a round die: centre of the floor
};

}  // namespace pulvis
