// A particle divided into grains: their corners and faces, without gaps.
#pragma once

#include <vector>

#include "scenes/grains/voronoi.hpp"
#include "scenes/outlines/outline_curve.hpp"

namespace pulvis {

struct GrainMap {
  static constexpr int outside = -1;
  struct Vertex {
    Vec2 at;              // m, in the particle's frame
    double s = -1;        // m, position on the outline; < 0: inside
    bool corner = false;  // of the outline
    bool on_outline() const { return s >= 0; }
  };
  struct
      Side {  // from its vertex to that of the next side; along the outline if there is no neighbour
    int vertex;
    int neighbour;  // grain, or outside
    int edges = 0;  // of the mesh
  };
  std::vector<Vertex> vertices;
  std::vector<std::vector<Side>> grains;  // counter-clockwise
};

// m, length of a side: straight, or along an outline of this length.
double side_length(const GrainMap& map, const std::vector<GrainMap::Side>& grain, std::size_t side,
                   double outline);

// Merges the ends of sides shorter than `least` (m); grains that vanish are removed.
void join_short_sides(GrainMap& map, double least, const OutlineCurve& outline);

// Edges of about length `size` (m): equal numbers on both sides of a face; per grain an even number of at least 8.
void divide_sides(GrainMap& map, double size, double outline);

}  // namespace pulvis
