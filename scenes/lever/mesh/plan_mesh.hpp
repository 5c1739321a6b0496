// Plane quad meshes from which levers and tips are extruded.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "scenes/spec/scene.hpp"

namespace pulvis {

struct PlanMesh {
  std::vector<Vec2> points;               // m
  std::vector<std::array<int, 4>> quads;  // counter-clockwise
  // Of six nodes: corners counter-clockwise, then the midpoints of the edges 01, 12, 20. Meshes made by Pulvis
  // have none.
  std::vector<std::array<int, 6>> triangles;
};

// A grid of points, `along` by `across` quads, counter-clockwise from i to j.
void add_grid(PlanMesh& mesh, int along, int across, double tolerance,
              const std::function<Vec2(int i, int j)>& point);
// A four-sided patch: corners counter-clockwise, lines at the fractions `along` from the first to the second
// corner and `across` from the second to the third. Points within `tolerance` of an existing one
// are shared.
void add_patch(PlanMesh& mesh, const std::array<Vec2, 4>& corners, const std::vector<double>& along,
               const std::vector<double>& across, double tolerance);
std::vector<double> even_shares(int count);  // 0, 1/count, ..., 1
// The disc of radius 1: a square core, 1 wide, of `across` by `across` quads in a ring whose layers lie at `ring`,
// from 0 at the core to 0.5 at the rim.
PlanMesh unit_disc(int across, const std::vector<double>& ring);
// The disc's rim on one of its four sides, counter-clockwise from its lower right corner; j from 0 to `across`.
Vec2 rim_of_disc(int side, int j, int across);

struct PlaceInQuad {
  double xi = 0, eta = 0;  // in [-1, 1]
  std::array<double, 4> weights() const;
};
struct PlanShare {
  int point = 0;
  double weight = 0;
};
// The weights for interpolating a field at a place from the mesh's points; empty outside the mesh.
std::optional<std::vector<PlanShare>> locate(const PlanMesh& mesh, const Vec2& point);

}  // namespace pulvis
