// Hollows: the inner boundaries of shapes with holes. Resource: fixed once the scene is built, and only there where
// a shape has one.
#pragma once

#include <cstdint>
#include <vector>

namespace pulvis {

struct Hollows {
  static constexpr const char* resource_name = "hollows";
  static constexpr bool fixed = true;
  using Loop = std::vector<std::int32_t>;  // nodes, the material to the left

  std::vector<std::vector<Loop>> of_shape;  // [shapes]: none, or one of every hole
};

}  // namespace pulvis
