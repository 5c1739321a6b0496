// Hollows: the inner boundaries of shapes with holes. Resource: fixed once the scene is built, and present only if
// a shape has holes.
#pragma once

#include <cstdint>
#include <vector>

namespace pulvis {

struct Hollows {
  static constexpr const char* resource_name = "hollows";
  static constexpr bool fixed = true;
  using Loop = std::vector<std::int32_t>;  // nodes, with the material on the left

  std::vector<std::vector<Loop>> of_shape;  // [shapes]: empty, or one loop per hole
};

}  // namespace pulvis
