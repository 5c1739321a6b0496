// Column of the inerters at the boundary (systems/body/inerter_kernel.hpp).
#pragma once

#include "components/entities.hpp"

namespace pulvis {

struct Inertance : Component<Node, double, 1> {
  static constexpr ComponentInfo info{
      "inertance", "-", "c of the inerter that begins here; 0 where a constraint holds its nodes"};
};

}  // namespace pulvis
