// Walls of STL tools that are too thin: a point that penetrates by more than half of a wall is pushed out on its far side.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "scenes/spec/scene.hpp"

namespace pulvis::space {

struct ThinWall {
  double thickness = 0;  // m
  Vec3 at;               // m, on one of its sides
};
// Where the surface is nearest to its other side, measured inwards from points on all triangles; nothing if no wall is
// thinner than `below`, m.
std::optional<ThinWall> thinnest_wall(const std::vector<std::array<Vec3, 3>>& triangles,
                                      double below);

// For every STL tool at most one.
std::vector<std::string> thin_wall_warnings(const Scene& scene);

}  // namespace pulvis::space
