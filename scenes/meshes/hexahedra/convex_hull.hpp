// Convex polyhedra from their faces or their corners: by brute force, for tens of corners.
#pragma once

#include <vector>

#include "scenes/spec/scene.hpp"

namespace pulvis::space {

struct HalfSpace {
  Vec3 normal;    // outward unit vector
  double offset;  // m: normal . x <= offset inside
};

std::vector<HalfSpace> faces_of_hull(const std::vector<Vec3>& points);
// Corners of the intersection of all half-spaces.
std::vector<Vec3> corners_between(const std::vector<HalfSpace>& faces);

}  // namespace pulvis::space
