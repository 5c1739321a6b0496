// The nodes of a shape as systems/body/inerter_kernel.hpp couples them: each boundary node with one or two behind it.
#pragma once

#include <array>
#include <vector>

#include "components/entities.hpp"

namespace pulvis {

// No node is in two chains. `single`: the nodes in none of them, in ascending order.
struct InerterChains {
  struct Chain {
    // From the boundary inwards; the second is on the boundary too where the body is one element thick.
    std::array<Row<Node>, 3> nodes;
    int links =
        1;  // inerters, between nodes that follow each other: with one, the third node is none
    std::array<double, 2> reduced =
        {};                 // [links] reduced mass of the two nodes over density times depth
    double inv_shared = 0;  // 1 / size of the second node
  };
  std::vector<Chain> all;
  std::vector<Row<Node>> single;
};

}  // namespace pulvis
