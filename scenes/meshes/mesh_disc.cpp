// Disc: four sides of 90 degrees. With a refinement the sides that face the poles get more edges than the
// flanks, so that their longest edges, next to the flanks, are as long as those of the flanks: the contact
// curve, uniform in its knots, would deviate from the circle where the edge length jumps.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "engine/portable_math.hpp"
#include "scenes/meshes/contact_curve.hpp"
#include "scenes/meshes/mesh_outlines.hpp"
#include "scenes/meshes/mesh_round.hpp"
#include "scenes/meshes/o_grid.hpp"

namespace pulvis {
namespace {

// Edges of a side that faces a pole, finer by `refinement` in its middle than at its ends, where their
// length tends to 1 (geometric).
std::vector<double> pole_edges(int edges, double refinement) {
  std::vector<double> length;
  for (int e = 0; e < edges; ++e)
    length.push_back(portable::pow(refinement, std::abs(2 * e + 1 - edges) / double(edges) - 1));
  return length;
}

// How many edges of half the outline face the pole; two are left for the flank, if there are enough.
int pole_share(int edges, double refinement) {
  int best = edges / 2;
  double minimum = std::numeric_limits<double>::max();
  for (int pole = edges / 2; pole <= std::max(edges / 2, edges - 2); ++pole) {
    const std::vector<double> length = pole_edges(pole, refinement);
    const double total = std::accumulate(length.begin(), length.end(), 0.0);
    const double jump = std::abs(portable::log((edges - pole) / total));
    if (jump >= minimum) continue;
    minimum = jump;
    best = pole;
  }
  return best;
}

}  // namespace

void mesh_outline(const DiscOutline& disc, const DiscMesh& mesh, double phase, Shape& shape) {
  const int half = mesh.boundary_edges / 2;
  const int pole = pole_share(half, mesh.refinement);
  const std::vector<double> flank(static_cast<std::size_t>(half - pole), 1.0);
  mesh_round({{disc.diameter, disc.diameter},
              disc.diameter / 2,
              stations_of(pole_edges(pole, mesh.refinement)),
              stations_of(flank),
              mesh.rings,
              mesh.refinement,
              mesh.refinement > 1 ? 0 : short_wave_filter,
              mesh.core == DiscMesh::Core::coarse},
             phase, shape);
}

}  // namespace pulvis
