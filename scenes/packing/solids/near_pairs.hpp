// Pairs of spheres that are close to each other.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "scenes/packing/solids/vector.hpp"

namespace pulvis::space {

struct Ball {
  V3 centre;
  double radius;
};

// All pairs of spheres with a gap below `range`, lower number first; the order depends only on positions.
std::vector<std::pair<std::int32_t, std::int32_t>> near_pairs(const std::vector<Ball>& balls,
                                                              double range);

}  // namespace pulvis::space
