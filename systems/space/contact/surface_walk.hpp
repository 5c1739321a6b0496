// Walking over the faces of a surface: where a point that leaves a face across a side enters the next one.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "components/space/contact.hpp"
#include "components/space/shape.hpp"
#include "systems/space/contact/patch_kernel.hpp"

namespace pulvis::space {

// A point on the surface of a particle.
struct SurfaceSpot {
  int face;
  double u, v;
};

inline constexpr int no_side = -1;

// The side across which a point has left its face; if there are two, the one it is farther beyond.
inline int side_left(double u, double v) {
  const double out_u = std::max(-u, u - 1), out_v = std::max(-v, v - 1);
  if (std::max(out_u, out_v) <= 0) return no_side;
  if (out_u >= out_v) return u > 1 ? 1 : 3;
  return v > 1 ? 2 : 0;
}

// Position along a side, counter-clockwise from 0 to 1, and distance beyond it.
struct BesideSide {
  double along, beyond;
};
inline BesideSide beside(int side, double u, double v) {
  switch (side) {
    case 0:
      return {u, -v};
    case 1:
      return {v, u - 1};
    case 2:
      return {1 - u, v - 1};
    default:
      return {1 - v, -u};
  }
}
// The point of a face at distance `beyond` inwards from its side.
inline SurfaceSpot inside(int face, int side, double along, double beyond) {
  switch (side) {
    case 0:
      return {face, along, beyond};
    case 1:
      return {face, 1 - beyond, along};
    case 2:
      return {face, 1 - along, 1 - beyond};
    default:
      return {face, beyond, 1 - along};
  }
}

// Position in the next face of a point that left its face across `side`; on the side itself if there is no next face.
inline SurfaceSpot across(const Shape& shape, const SurfaceSpot& spot, int side) {
  const Shape::Neighbour& next = entry(entry(shape.faces, spot.face).neighbour, side);
  const BesideSide at = beside(side, spot.u, spot.v);
  const double along = std::clamp(at.along, 0.0, 1.0);
  if (next.face < 0) return inside(spot.face, side, along, 0);
  return inside(next.face, next.side, 1 - along, std::clamp(at.beyond, 0.0, 1.0));
}

// Of all corners and centres of a particle's faces, the one nearest to a point. `first`: the particle's Bezier points.
inline SurfaceSpot nearest_spot(const Shape& shape, const double* first, const Point& point) {
  constexpr double spots[5][2] = {{0, 0}, {1, 0}, {0, 1}, {1, 1}, {0.5, 0.5}};
  SurfaceSpot nearest{0, 0.5, 0.5};
  double least = std::numeric_limits<double>::infinity();
  for (int f = 0; f < static_cast<int>(shape.faces.size()); ++f) {
    const PatchNumbers control{first, entry(shape.faces, f).number.data()};
    for (const auto& [u, v] : spots) {
      const kernels::Vector<double> x = kernels::patch_slopes<double>(control, u, v).x;
      const kernels::Vector<double> r{point[0] - x.x, point[1] - x.y, point[2] - x.z};
      if (!(dot(r, r) < least)) continue;
      least = dot(r, r);
      nearest = {f, u, v};
    }
  }
  return nearest;
}

// Cosine of the angle between a normal found on a face and the mean normal of the face, spanned by its diagonals.
inline double along_face(const PatchNumbers& face, const kernels::Vector<double>& normal) {
  const auto corner = [&](int p) {
    return kernels::Vector<double>{face(0, p), face(1, p), face(2, p)};
  };
  const kernels::Vector<double> whole = cross(corner(15) - corner(0), corner(12) - corner(3));
  return dot(whole, normal) / std::sqrt(dot(whole, whole));
}

}  // namespace pulvis::space
