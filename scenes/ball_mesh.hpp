// A ball of hexahedra: a cubic core in six shells.
#pragma once

#include "scenes/solid_draft.hpp"

namespace pulvis {

struct BallMesh {
  Vec3 centre = Vec3::Zero();
  std::vector<std::array<int, 4>> faces;  // of the surface, nodes of the draft
  int pole = 0;                           // lowest node
  std::vector<std::int32_t> lower;        // nodes of the lower half of the surface
  std::vector<double> lower_area;         // m^2, their shares of it
};

// `across`: quads along an edge of the core, even, so that the pole is a node.
BallMesh add_ball(SolidDraft& draft, const Vec3& centre, double radius, int across, double focus);
// Moves a node onto the nearest face of the ball and hangs it there.
void tie_to_ball(SolidDraft& draft, const BallMesh& ball, int node);

}  // namespace pulvis
