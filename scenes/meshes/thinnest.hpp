// Smallest thickness that surfaces could pass through within one time step.
#pragma once

#include <vector>

#include "components/shape.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

// m: smallest width of an element. Any path through the particle crosses one (except at a tip).
double thinnest_part(const Shape& shape);

// m: shortest path through the body of a polyline tool, from one flank to another, where that is below `maximum`;
// infinite otherwise. `chain`: its points, the powder to the left. Protrusions below `resolution`
// do not count: a tip has no thickness, and outlines with edges that long do not resolve it.
double thinnest_part(const std::vector<Vec2>& chain, double resolution, double maximum);

}  // namespace pulvis
