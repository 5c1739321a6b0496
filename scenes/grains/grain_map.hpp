// A particle cut into grains: their corners and faces, without gaps.
#pragma once

#include <vector>

#include "scenes/grains/voronoi.hpp"
#include "scenes/outlines/outline_curve.hpp"

namespace pulvis {

struct GrainMap {
  static constexpr int outside = -1;
  struct Vertex {
    Vec2 at;              // m, in the particle's frame
    double s = -1;        // m, where it is on the outline; < 0: inside
    bool corner = false;  // of the outline
    bool on_outline() const { return s >= 0; }
  };
  struct
      Side {  // from its vertex to that of the next side; along the outline where nobody is behind it
    int vertex;
    int neighbour;  // grain, or outside
    int edges = 0;  // of the mesh
  };
  std::vector<Vertex> vertices;
  std::vector<std::vector<Side>> grains;  // counter-clockwise
};

// m, of a side: straight, or along an outline of this length.
double side_length(const GrainMap& map, const std::vector<GrainMap::Side>& grain, std::size_t side,
                   double outline);

// Joins the ends of sides shorter than `least` (m); grains of which nothing is left are gone.
void join_short_sides(GrainMap& map, double least, const OutlineCurve& outline);

// Edges about as long as `size` (m): as many on both sides of a face, and of every grain an even number of at least 8.
void divide_sides(GrainMap& map, double size, double outline);

}  // namespace pulvis
