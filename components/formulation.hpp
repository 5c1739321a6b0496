// The element formulations of a scene: where an element's stresses stand, and what keeps its shape.
// All are four-node quads; the systems of the elements are templates of them.
#pragma once

namespace pulvis {

// 2x2 Gauss points, one dilatation for the whole element (mean dilatation).
struct FourPoint {
  static constexpr int points = 4;   // with a deviator and a plastic state each
  static constexpr int volumes = 1;  // with a mean stress each
  static constexpr bool stabilised = false;
};

// 2x2 Gauss points, each with its own dilatation. Locks where volume is kept: the negative control.
struct Standard {
  static constexpr int points = 4;
  static constexpr int volumes = 4;
  static constexpr bool stabilised = false;
};

// One point at the centre, and the two bending modes that it cannot see (systems/body/hourglass_kernel.hpp).
struct OnePoint {
  static constexpr int points = 1;
  static constexpr int volumes = 1;
  static constexpr bool stabilised = true;
};

}  // namespace pulvis
