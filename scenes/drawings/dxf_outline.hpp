// The outline in a DXF file: LINE, ARC, CIRCLE, LWPOLYLINE with bulges, SPLINE.
#pragma once

#include <string>

#include "scenes/drawings/chains.hpp"

namespace pulvis::drawing {

// `unit`: of a length of 1 in the drawing, where its header has no $INSUNITS; empty: it must. `layer`: the
// layer that is meant; empty: all.
std::vector<Chain> chains_of_dxf(const std::string& text, const std::string& unit,
                                 const std::string& layer = {});

}  // namespace pulvis::drawing
