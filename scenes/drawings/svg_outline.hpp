// The outline in an SVG file: paths and shapes, in the units of its viewBox.
#pragma once

#include <string>

#include "scenes/drawings/chains.hpp"

namespace pulvis::drawing {

// `unit`: of a length of 1 in the drawing, where its size does not say it ("um"); empty: it must. `layer`: the id or
// Inkscape's label of the group or shape that is meant; empty: all.
std::vector<Chain> chains_of_svg(const std::string& text, const std::string& unit,
                                 const std::string& layer = {});

}  // namespace pulvis::drawing
