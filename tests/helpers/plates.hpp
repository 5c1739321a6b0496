// Tools that many scenes of tests in three dimensions have.
#pragma once

#include <string>

namespace pulvis {

// A plane `bottom` at z = 0 and a plane `top` above it, "10 mm".
inline std::string plates(const std::string& height) {
  return R"(
[[tool]]
name = "bottom"
shape = "plane"
point = ["0 mm", "0 mm", "0 mm"]
normal = [0, 0, 1]

[[tool]]
name = "top"
shape = "plane"
point = ["0 mm", "0 mm", ")" +
         height + R"("]
normal = [0, 0, -1]
)";
}

}  // namespace pulvis
