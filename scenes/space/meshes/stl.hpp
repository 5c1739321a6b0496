// Triangles from STL files, binary or of text.
#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "scenes/space/meshes/triangle.hpp"

namespace pulvis::space {

// What is wrong with the file, with what is allowed.
struct BadStl : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// In the file's own unit, as they come. Throws BadStl: a file that cannot be read, is cut short, holds numbers that are not
// finite, or whose triangles do not close a body or face inwards.
std::vector<Triangle> read_stl(const std::string& path);
std::vector<Triangle> stl_triangles(const std::string& bytes);

// Why the centre of its volume does not see the whole surface, or nothing.
std::optional<std::string> why_not_star_shaped(const std::vector<Triangle>& triangles);

// Of a closed surface.
double volume_of(const std::vector<Triangle>& triangles);       // m^3
Vec3 centre_of_volume(const std::vector<Triangle>& triangles);  // m

}  // namespace pulvis::space
