// [die]: the die cavity, given once. It is copied into the packings and tools before they are read.
#pragma once

#include <optional>

#include "scenes/language/vectors.hpp"

namespace pulvis {

struct DieSpec {
  std::optional<double> width;  // m
  std::optional<Vec2> corner;   // m, lower left
};

}  // namespace pulvis
