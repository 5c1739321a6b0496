// initial_tool_bonds: bonds surfaces that touch tools at the start: glued grips, in three dimensions.
//
// Law      as between particles (systems/space/contact/initial_bonds.cpp)
// Runs     once, at the start, after the first search for contacts
// Active   when the scene has bonds with tools that exist from the start
#include <algorithm>

#include "systems/contact/bond_strength.hpp"
#include "systems/space/contact/gauss_points.hpp"
#include "systems/space/tools/systems.hpp"
#include "systems/space/tools/tool_anchors.hpp"
#include "systems/space/tools/tool_gap.hpp"

namespace pulvis::space {

void initial_tool_bonds::operator()() const {
  for (int r = 0; r < rows.pair.rows(); ++r) {
    const Row<FaceToolContact> row(r);
    const int slot = rows.pair(row, 0), tool = rows.pair(row, 2);
    const auto& body = entry(bodies.bodies->slots, slot);
    const int number = rows.rules->initial_with_tool(tool, body);
    if (number == 0) continue;
    const BondRules::Law& law = rows.rules->law(number);
    const Shape::Face& face = entry(bodies.shape_of(slot).faces, rows.pair(row, 1));
    const PatchNumbers own{position.values().data() + bodies.outline_begin(slot),
                           face.number.data()};
    const double strength = drawn_strength(law, body.number, -1 - tool);
    for (int half = 0; half < 2; ++half) {
      const VectorLanes at = sampled_points(own, half);
      const SurfaceGap nearest = gap_to_tool(tools, triangles, tool, row, at, face.size);
      unsigned made = 0;
      for (int l = 0; l < lane_count; ++l) {
        const double gap = std::max(-nearest.gap[l], 0.0);  // overlaps are bonded at any depth
        entry(totals->nearest, number - 1).take(gap, face.size);
        if (gap > law.reach * face.size) continue;
        rows.make(row, lane_count * half + l, strength, -nearest.gap[l]);
        entry(totals->made, number - 1) += 1;
        made |= 1U << l;
      }
      if (made == 0) continue;
      set_anchors(anchor, {row, half, made}, at, nearest, tools.position_of(tool));
      activation(row, half) = 0;
    }
  }
}

}  // namespace pulvis::space
