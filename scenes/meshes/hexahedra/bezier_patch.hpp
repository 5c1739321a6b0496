// The undeformed smooth surface: points, tangents and areas of its patches.
#pragma once

#include <array>
#include <vector>

#include "components/space/shape.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis::space {

struct PatchPlace {
  double u, v, weight;  // in the unit square
};
PatchPlace gauss_place(int point);  // one of a face's 4 x 4 points, u first

struct PatchPoint {
  Vec3 at, by_u, by_v;
  Vec3 area() const { return by_u.cross(by_v); }  // outward, per unit area of the unit square
};
// What each Bezier point of a face counts at a place of it: where many faces are looked at, the same for all.
struct PointWeights {
  double at, by_u, by_v;
};
using PatchWeights = std::array<PointWeights, 16>;
PatchWeights patch_weights(double u, double v);
// `points`: the particle's Bezier points.
PatchPoint patch_at(const std::array<int, 16>& numbers, const std::vector<Vec3>& points,
                    const PatchWeights& weights);
PatchPoint patch_at(const std::array<int, 16>& numbers, const std::vector<Vec3>& points, double u,
                    double v);
inline PatchPoint patch_at(const Shape::Face& face, const std::vector<Vec3>& points, double u,
                           double v) {
  return patch_at(face.point, points, u, v);
}
// m^3, between the origin and a patch.
double volume_under(const std::array<int, 16>& numbers, const std::vector<Vec3>& points);

// Bezier points for a mesh with the given nodes.
std::vector<Vec3> surface_points_of(const Shape& shape, const std::vector<Point>& nodes);

}  // namespace pulvis::space
