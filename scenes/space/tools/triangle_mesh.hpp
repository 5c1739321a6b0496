// The surface of an STL tool, made ready for contact.
#pragma once

#include <array>
#include <vector>

#include "components/space/tools.hpp"
#include "scenes/spec/space_scene.hpp"

namespace pulvis::space {

// Corners that coincide exactly are one. Triangles without area are left out.
TriangleMesh triangle_mesh(const std::vector<std::array<Vec3, 3>>& triangles);

}  // namespace pulvis::space
