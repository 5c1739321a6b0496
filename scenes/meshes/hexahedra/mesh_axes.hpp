// Orientation of the cube of a cubed-sphere mesh in a shape that has no axes of its own: a polyhedron or a scan in the
// orientation of its file.
#pragma once

#include <vector>

#include "scenes/meshes/hexahedra/star_surface.hpp"

namespace pulvis::space {

// A shape as seen from axes rotated by `axes` from its own. Keeps a reference to the surface.
class TurnedSurface final : public StarSurface {
 public:
  // `points`: of the surface, in its own axes, enough to determine its extents.
  TurnedSurface(const StarSurface& surface, const Rotation& axes, const std::vector<Vec3>& points);

  double radius(const Vec3& d) const override { return surface_.radius(axes_ * d); }
  Vec3 normal(const Vec3& d) const override {
    return axes_.transpose() * surface_.normal(axes_ * d);
  }
  Spot spot(const Vec3& d) const override {
    const Spot own = surface_.spot(axes_ * d);
    return {own.radius, axes_.transpose() * own.normal};
  }
  Vec3 half_size() const override { return half_size_; }
  double volume() const override { return surface_.volume(); }
  double roundness() const override { return surface_.roundness(); }

  Vec3 in_own_axes(const Vec3& p) const { return axes_ * p; }

 private:
  const StarSurface& surface_;
  Eigen::Matrix3d axes_;
  Vec3 half_size_;
};

// The surface in rotated axes in which its mesh may fit it better than in its own, as far as a search finds them: the axes
// of the smallest box around it, and those with a clearly smaller deviation of a mesh with `divisions` divisions.
std::vector<TurnedSurface> turned_to_fit(const StarSurface& surface, int divisions);

}  // namespace pulvis::space
