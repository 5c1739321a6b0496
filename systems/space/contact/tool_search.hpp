// Which faces are near which tools: pure geometry, no columns but what it is given.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "components/space/tools.hpp"
#include "systems/contact/by_slot.hpp"
#include "systems/space/contact/box.hpp"

namespace pulvis::space {

struct ToolCandidate {
  std::int32_t slot, face, tool;
};

struct FaceLook {
  const ShapedBodies& bodies;
  std::span<const double> positions;  // of all Bezier points
  const ToolSurfaces& tools;
  double skin;

  // Whether the face can touch the tool before the skin is used up, or stands behind its surface: of punches and meshes by
  // up to its own size. (Deeper than that no force would be right.)
  bool can_touch(int slot, int face, int tool) const;
  // Those of a mesh tool that can be nearest then.
  void add_triangles(const ToolCandidate& candidate, std::vector<std::int32_t>& list) const;
};

// All, sorted by (slot, face, tool).
BySlot<ToolCandidate> tool_candidates(const FaceLook& look);

// The triangles whose boxes are within `reach` of a box, ascending.
void triangles_near(const TriangleMesh& mesh, const Box& box, double reach,
                    std::vector<std::int32_t>& list);

}  // namespace pulvis::space
