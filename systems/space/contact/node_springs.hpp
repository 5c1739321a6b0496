// Springs that keep surface nodes near the smooth surface, which alone is in contact.
//
// Why      Contact hardly resists a pattern of nodes that hardly moves the smooth surface, such as a checkerboard. On faces
//          with few elements such patterns grow under large compression, until nodes have passed through tools
// Law      node x, its point s of the smooth surface, e = |x - s| - slack: force k e on both, towards each other, where e > 0.
//          k = K/8 A/V a, with the area a of the node. The slack is 1.1 times the undeformed distance, and at least a
//          tenth of the faces where the shape is flat. Where it is curved nodes also leave the surface as it flattens,
//          by a quarter of the faces and more in dense powders: the slack is four tenths there
// Energy   energy k e^2/2, counted as elastic. The force is central: momentum and moment of momentum are conserved
#pragma once

#include "engine/chunk_lane.hpp"
#include "systems/space/contact/systems.hpp"
#include "systems/space/contact/vector.hpp"

namespace pulvis::space {

inline constexpr double node_growth = 1.1;   // of the undeformed distance
inline constexpr double flat_slack = 0.1;    // of the size of the faces, where the shape is flat
inline constexpr double curved_slack = 0.4;  // elsewhere
inline constexpr double node_stiffness = 1.0 / 8;  // of the bulk modulus

// Of eight particles.
struct NodeSpring {
  kernels::Vector<Lane> force;  // N, on the node; the opposite acts on the surface
  Lane energy;                  // J
};
// `away`: m, of the node from its point. `bulk`: Pa.
inline NodeSpring node_spring(const Shape::SurfaceNode& node, const kernels::Vector<Lane>& away,
                              const Lane& bulk) {
  const Lane distance = sqrt(dot(away, away)), excess = max(distance - node.slack, Lane{});
  const Lane pull = (node_stiffness * node.stiffness) * bulk * excess;
  const Lane scale = select(excess > 0.0, -(pull / distance), Lane{});
  return {scale * away, 0.5 * pull * excess};
}

// m, of a surface node of eight particles from its point.
inline kernels::Vector<Lane> away_from_surface(const ShapedBodies<ThreeD>& bodies,
                                               const NodesOfSurface& of, Chunk chunk, int number) {
  const Shape::SurfaceNode& node = entry(bodies.shape_of(chunk).surface_node, number);
  const auto x = of.nodes.chunk(chunk);
  std::array<Lane, 3> d;
  for (int k = 0; k < 3; ++k) {
    const Lane at = x(Row<Node>(number), k);
    entry(d, k) =
        at - Lane::from([&](int lane) {
          const int slot = ChunkLane(chunk, lane).slot();
          if (bodies.is_absent(slot)) return at[lane];
          return entry(of.surface.values(), bodies.outline_begin(slot) + 3 * node.point + k);
        });
  }
  return {d[0], d[1], d[2]};
}

}  // namespace pulvis::space
