// Pairs of balls that are near each other.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "scenes/space/packing/vector.hpp"

namespace pulvis::space {

struct Ball {
  V3 centre;
  double radius;
};

// Of all balls whose gap is below `range`, the lower number first; in an order that the places alone decide.
std::vector<std::pair<std::int32_t, std::int32_t>> near_pairs(const std::vector<Ball>& balls,
                                                              double range);

}  // namespace pulvis::space
