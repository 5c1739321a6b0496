// The outline in an SVG file: paths and shapes, in the units of its viewBox.
#pragma once

#include <string>

#include "scenes/drawings/chains.hpp"

namespace pulvis::drawing {

// `unit`: of a length of 1 in the drawing, where its size does not say it ("um"); empty: it must.
std::vector<Chain> chains_of_svg(const std::string& text, const std::string& unit);

}  // namespace pulvis::drawing
