// Which pieces of a tool's polyline are near a box: a binary tree of boxes over the chain, so that a
// search costs the logarithm of its length. Pure geometry, no columns.
#pragma once

#include "components/surface.hpp"
#include "systems/contact/broad_phase.hpp"

namespace pulvis {

struct PieceRange {
  std::int32_t first = 0, last = -1;  // empty range: last < first
  bool empty() const { return last < first; }
};

// Fills `tree`; called once, when the chain is built.
void index_pieces(ToolSurface& surface);

// From the first to the last piece with a point within `reach` of `box` (in the tool's frame). Exact for
// the lines of the straight parts; pieces in between need not be near.
PieceRange pieces_near(const ToolSurface& surface, const Box& box, double reach);

}  // namespace pulvis
