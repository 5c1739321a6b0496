// How thin the things are that surfaces could pass through within a step of the run.
#pragma once

#include <vector>

#include "components/shape.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

// m: smallest width of an element. A path through the particle crosses one at least (but at a tip).
double thinnest_part(const Shape& shape);

// m: shortest path through the body of a polyline tool, from one flank to another, where that is below `maximum`;
// infinite otherwise. `chain`: its points, the powder to the left. What stands out by less than `resolution`
// does not count: a tip has no thickness, and outlines of such edges do not feel it.
double thinnest_part(const std::vector<Vec2>& chain, double resolution, double maximum);

}  // namespace pulvis
