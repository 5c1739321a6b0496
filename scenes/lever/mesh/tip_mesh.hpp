// Tips and colloid probes: meshed separately and tied to the lever's lower face, whatever its mesh.
#pragma once

#include "scenes/lever/mesh/lever_mesh.hpp"

namespace pulvis {

double tip_height(const TipSpec& tip);  // m, from the lever's lower face to the tip's end

struct TipMesh {
  std::vector<SolidMesh::Support> end;  // nodes of the tip's end and their shares of a force on it
  std::vector<std::int32_t> surface;    // nodes that can touch: the lower half of a sphere
  std::vector<double> area;             // m^2, of these nodes
};

// Interfaces of the element layers in a block, pyramid or cone: m below the lever, closer together near it.
std::vector<double> tip_levels(const TipSpec& tip, double foot_edge, double coarser);

// Without a tip: the point of the lever's lower face under its axis. A ball with an analytical contact law
// touches where the normal `out` of the sample, in the lever's frame, meets it: a point that moves rigidly
// with the ball, because the law includes the ball's own compliance.
TipMesh add_tip(SolidDraft& draft, const LeverSpec& lever, const LeverMesh& mesh,
                const TipSpec& tip, const std::optional<Vec3>& out = {});

}  // namespace pulvis
