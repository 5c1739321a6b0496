// Tips and colloid probes: meshed on their own and tied to the lever's lower face, whatever its mesh.
#pragma once

#include "scenes/lever/mesh/lever_mesh.hpp"

namespace pulvis {

double tip_height(const TipSpec& tip);  // m, from the lever's lower face to the tip's end

struct TipMesh {
  std::vector<SolidMesh::Support> end;  // nodes of the tip's end and their shares of a force on it
  std::vector<std::int32_t> surface;    // nodes that can touch: of a sphere, its lower half
  std::vector<double> area;             // m^2, theirs
};

// Where the elements meet that a block, pyramid or cone is stacked of: m below the lever, shorter towards it.
std::vector<double> tip_levels(const TipSpec& tip, double foot_edge, double coarser);

// Without a tip: the point of the lever's lower face under its axis. A ball that touches by a law of its own
// does so where the normal `out` of the sample, in the lever's frame, meets it: a point that moves with the
// ball as a whole, since the law has the ball's own yielding in it.
TipMesh add_tip(SolidDraft& draft, const LeverSpec& lever, const LeverMesh& mesh,
                const TipSpec& tip, const std::optional<Vec3>& out = {});

}  // namespace pulvis
