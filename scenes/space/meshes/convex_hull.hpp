// Convex polyhedra by their faces and by their corners: of tens of corners, by trying all.
#pragma once

#include <vector>

#include "scenes/spec/space_scene.hpp"

namespace pulvis::space {

struct HalfSpace {
  Vec3 normal;    // outward unit vector
  double offset;  // m: normal . x <= offset inside
};

std::vector<HalfSpace> faces_of_hull(const std::vector<Vec3>& points);
// Corners of what all half-spaces have in common.
std::vector<Vec3> corners_between(const std::vector<HalfSpace>& faces);

}  // namespace pulvis::space
