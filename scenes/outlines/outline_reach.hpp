// How far a turned outline reaches from its origin along a direction of space (a unit vector).
#pragma once

#include "scenes/spec/scene.hpp"

namespace pulvis {

double reach_along(const Outline& outline, double angle, const Vec2& direction);  // m

}  // namespace pulvis
