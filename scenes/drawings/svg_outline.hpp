// The outline in an SVG file: paths and shapes, in the units of its viewBox.
#pragma once

#include <string>

#include "scenes/drawings/chains.hpp"

namespace pulvis::drawing {

// `unit`: length unit of the drawing if its size does not give it ("um"); empty: the size must. `layer`: the id or
// Inkscape label of the group or shape to read; empty: all.
std::vector<Chain> chains_of_svg(const std::string& text, const std::string& unit,
                                 const std::string& layer = {});

}  // namespace pulvis::drawing
