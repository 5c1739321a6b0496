// Bezier points of the smooth surface as combinations of its control net: see smooth_surface.hpp.
#pragma once

#include <map>
#include <vector>

#include "scenes/space/meshes/surface_net.hpp"

namespace pulvis::space {

using Combination = std::map<int, double>;  // number -> weight
void add(Combination& to, const Combination& from, double factor);

// Numbers of Bezier points: of a node; on the side that starts in a corner, next to it; inside, next to it.
struct PointNumbers {
  int nodes, faces;
  int at(int node) const { return node; }
  int beside(SurfaceNet::Corner c) const { return nodes + 4 * c.face + c.corner; }
  int inside(SurfaceNet::Corner c) const { return nodes + 4 * faces + 4 * c.face + c.corner; }
  int count() const { return nodes + 8 * faces; }
};

// [points] over the nodes of the net.
std::vector<Combination> bezier_points(const SurfaceNet& net);
// The numbers of a face's points, u first.
std::array<int, 16> points_of(const SurfaceNet& net, int face);

}  // namespace pulvis::space
