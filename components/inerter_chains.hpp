// The nodes of a shape as systems/body/inerter_kernel.hpp couples them: each boundary node with those behind it.
#pragma once

#include <array>
#include <vector>

#include "components/entities.hpp"

namespace pulvis {

// Nodes of a chain of so many inerters: two or three from the boundary inwards, or the four of an element at a corner, as a
// closed ring.
constexpr int links_of_ring = 4;
constexpr int nodes_of_chain(int links) { return links == links_of_ring ? links : links + 1; }
// The second node of an inerter; the first has its number.
constexpr int next_in_chain(int link, int links) { return (link + 1) % nodes_of_chain(links); }

// No node is in two chains. `single`: the nodes in none of them, in ascending order.
struct InerterChains {
  struct Chain {
    std::array<Row<Node>, 4> nodes;
    int links = 1;                        // inerters: the i-th is between node i and the next one
    std::array<double, 4> reduced = {};   // [links] reduced mass of both over density times depth
    std::array<double, 4> inv_size = {};  // [nodes] 1 / size
  };
  std::vector<Chain> all;
  std::vector<Row<Node>> single;
};

}  // namespace pulvis
