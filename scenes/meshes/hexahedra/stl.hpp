// Triangles from STL files, binary or text.
#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "scenes/meshes/hexahedra/triangle.hpp"

namespace pulvis::space {

// What is wrong with the file, and what is allowed.
struct BadStl : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// In the file's own unit, in file order. Throws BadStl for a file that cannot be read, is truncated, contains non-finite
// numbers, or whose triangles do not form a closed surface or face inwards.
std::vector<Triangle> read_stl(const std::string& path);
std::vector<Triangle> stl_triangles(const std::string& bytes);

// Why the surface is not star-shaped about its centre of volume; empty if it is.
std::optional<std::string> why_not_star_shaped(const std::vector<Triangle>& triangles);

// For a closed surface.
double volume_of(const std::vector<Triangle>& triangles);       // m^3
Vec3 centre_of_volume(const std::vector<Triangle>& triangles);  // m

}  // namespace pulvis::space
