// The outline in a DXF file: LINE, ARC, CIRCLE, LWPOLYLINE with bulges, SPLINE.
#pragma once

#include <string>

#include "scenes/drawings/chains.hpp"

namespace pulvis::drawing {

// `unit`: of a length of 1 in the drawing, where its header has no $INSUNITS; empty: it must.
std::vector<Chain> chains_of_dxf(const std::string& text, const std::string& unit);

}  // namespace pulvis::drawing
