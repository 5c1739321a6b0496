// Closed surfaces with triangles without area.
#pragma once

#include <array>
#include <vector>

#include "scenes/spec/scene.hpp"

namespace pulvis::space {

// The same closed surface without triangles whose corners are in line: at the middle corner of each, the neighbour along its
// longest side is divided in two. Triangles on both sides of an edge then share it, and with it their normals. Triangles
// with two equal corners are left out.
std::vector<std::array<Vec3, 3>> without_flat_triangles(std::vector<std::array<Vec3, 3>> triangles);

}  // namespace pulvis::space
