// A ball of hexahedra: a cubic core surrounded by six shells, refined at the pole where requested.
#pragma once

#include <optional>

#include "scenes/lever/mesh/solid_draft.hpp"

namespace pulvis {

struct BallMesh {
  Vec3 centre = Vec3::Zero();
  std::vector<std::array<int, 4>> faces;  // on the surface, by nodes of the draft
  int pole = 0;                           // lowest node
  std::vector<std::int32_t> lower;        // nodes of the lower half of the surface
  std::vector<double> lower_area;         // m^2, surface area per node
};

struct BallShape {
  Vec3 centre = Vec3::Zero();
  double radius = 0;
  int across = 4;              // cells along an edge of the core, even, so that the pole is a node
  std::optional<double> edge;  // m, of the cells around the pole, up to ...
  double reach = 0;            // m, ... this distance from it; larger outside
};
BallMesh add_ball(SolidDraft& draft, const BallShape& shape);
// Moves a node onto the nearest face of the ball and ties it there.
void tie_to_ball(SolidDraft& draft, const BallMesh& ball, int node);

}  // namespace pulvis
