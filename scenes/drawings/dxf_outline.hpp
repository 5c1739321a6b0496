// The outline in a DXF file: LINE, ARC, CIRCLE, LWPOLYLINE with bulges, SPLINE.
#pragma once

#include <string>

#include "scenes/drawings/chains.hpp"

namespace pulvis::drawing {

// `unit`: length unit of the drawing if its header has no $INSUNITS; empty: it must have it. `layer`: the
// layer to read; empty: all.
std::vector<Chain> chains_of_dxf(const std::string& text, const std::string& unit,
                                 const std::string& layer = {});

}  // namespace pulvis::drawing
