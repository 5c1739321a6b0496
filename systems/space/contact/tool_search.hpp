// Finds which faces are near which tools: pure geometry, no columns except those passed in.
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
  const ShapedBodies<ThreeD>& bodies;
  std::span<const double> positions;  // of all Bezier points
  const ToolSurfaces& tools;
  double distance;  // m

  // Whether the face is within the distance of the tool, or is behind its surface: for bodies of revolution
  // and meshes by up to its own size. (At greater depth no force would be meaningful.)
  bool can_touch(int slot, int face, int tool) const;
  // Adds the triangles of a mesh tool that can be the nearest.
  void add_triangles(const ToolCandidate& candidate, std::vector<std::int32_t>& list) const;
};

// All candidates, sorted by (slot, face, tool).
BySlot<ToolCandidate> tool_candidates(const FaceLook& look);

// The triangles whose boxes are within `reach` of a box, ascending.
void triangles_near(const TriangleMesh& mesh, const Box& box, double reach,
                    std::vector<std::int32_t>& list);

}  // namespace pulvis::space
