// Connectivity of the faces of a closed surface of quads.
#pragma once

#include <array>
#include <vector>

#include "components/space/shape.hpp"

namespace pulvis::space {

struct SurfaceNet {
  struct Corner {
    int face = 0, corner = 0;
  };
  std::vector<std::array<int, 4>> quads;  // nodes, counter-clockwise as seen from outside
  std::vector<int> element;               // the one beneath each quad
  std::vector<std::array<Shape::Neighbour, 4>> neighbour;
  // The corners that meet at a node, counter-clockwise.
  std::vector<std::vector<Corner>> fan;

  int faces() const { return static_cast<int>(quads.size()); }
  int nodes() const { return static_cast<int>(fan.size()); }
  int valence(int node) const { return static_cast<int>(entry(fan, node).size()); }
  int node(Corner c, int ahead = 0) const {
    return entry(entry(quads, c.face), (c.corner + ahead) % 4);
  }
  // The corner at which the side that starts at `c` ends when traversed from the other face.
  Corner beyond(Corner c) const {
    const Shape::Neighbour& n = entry(entry(neighbour, c.face), c.corner);
    return {n.face, n.side};
  }
};

// From the sides of hexahedra that lie in the surface.
SurfaceNet surface_net(const Shape& shape);

}  // namespace pulvis::space
