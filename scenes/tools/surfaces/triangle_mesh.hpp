// The surface of an STL tool, prepared for contact.
#pragma once

#include <array>
#include <vector>

#include "components/space/tools.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis::space {

// Corners that coincide exactly are merged. Triangles with zero area are left out, and their neighbours divided at their
// corners (flat_triangles.hpp).
TriangleMesh triangle_mesh(const std::vector<std::array<Vec3, 3>>& triangles);

}  // namespace pulvis::space
