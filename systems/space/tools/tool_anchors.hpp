// The places of tools that hold bonded points.
#pragma once

#include <array>
#include <bit>

#include "components/space/bond.hpp"
#include "systems/space/contact/contact_law.hpp"
#include "systems/space/contact/projection.hpp"
#include "systems/space/tools/tool_projection.hpp"

namespace pulvis::space {

struct HalfOfRow {
  Row<FaceToolContact> row;
  int half;
  unsigned points;  // bit l: of the eight
};

// From now on the given points, at `at`, are held at the nearest places of the tool at `tool`. (m)
inline void set_anchors(const Write<ToolAnchor>& anchor, const HalfOfRow& of, const VectorLanes& at,
                        const SurfaceGap& nearest, const Point& tool) {
  const VectorLanes& n = nearest.normal;
  const VectorLanes place = fma(nearest.gap, n, at) - everywhere(tool);
  double* first = &anchor(of.row) + lane_count * of.half;
  for (unsigned left = of.points; left != 0; left &= left - 1) {
    const int l = std::countr_zero(left);
    const std::array<double, 6> numbers{place.x[l], place.y[l], place.z[l], n.x[l], n.y[l], n.z[l]};
    for (int k = 0; k < 6; ++k) first[face_points * k + l] = entry(numbers, k);
  }
}

}  // namespace pulvis::space
