// The nodes of a shape as systems/body/inerter_kernel.hpp couples them: each boundary node with one behind it.
#pragma once

#include <vector>

#include "components/entities.hpp"

namespace pulvis {

// No node is in two pairs. `single`: the nodes in none of them, in ascending order.
struct BoundaryPairs {
  struct Pair {
    Row<Node> outer;  // on the boundary
    Row<Node> inner;  // next inwards; on the boundary too where the body is one element thick
  };
  std::vector<Pair> all;
  std::vector<Row<Node>> single;
};

}  // namespace pulvis
