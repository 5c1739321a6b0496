// A vector of the plane, as scenes have it.
#pragma once

#include <Eigen/Core>

namespace pulvis {

using Vec2 = Eigen::Vector2d;

}  // namespace pulvis
