// A rigid triangulated surface over a rectangle of the plane, stored with FCL.
//
// Source   FCL finds the nearest triangle and those that are about as near; what is computed from them is
//          exact: the distance to a triangle's plane where the nearest point is inside it, to its edge or
//          corner otherwise. Ridges are sharp. A valley is rounded: there the distances d_i to its sides
//          are blended, d = - delta ln sum exp(-d_i / delta), so that a tip in it has a unique normal, which
//          turns from one side to the other over a few delta.
// Symbols  delta: m, a thousandth of `unit` (a map's spacing, a profile's height, a wave's facet). The blend lies
//          delta ln 2 = 7e-4 unit below the sides where they meet and vanishes 20 delta away from there.
#pragma once

#include <fcl/math/triangle.h>
#include <fcl/narrowphase/collision_object.h>

#include <memory>
#include <vector>

#include "components/probe.hpp"
#include "scenes/lever/mesh/solid_draft.hpp"

namespace pulvis {

class TriangleTarget : public TargetShape {
 public:
  // Triangles counter-clockwise seen from above. FCL's tolerances are absolute: lengths are passed
  // in units of `unit`.
  TriangleTarget(std::vector<Vec3> points, std::vector<fcl::Triangle> triangles, double unit);
  Nearest nearest(const Place& place) const override;

 private:
  struct Side {
    double distance;
    Vec3 normal;
    Eigen::Matrix3d turn;
  };
  void find_valleys();
  std::size_t nearest_triangle(const Vec3& p) const;
  std::vector<std::size_t> triangles_within(const Vec3& p, double distance) const;
  // The nearest point of a triangle, and on which side of it p lies.
  Side towards(const Vec3& p, std::size_t triangle) const;
  // Whether a triangle's plane bounds the space above it at p: p is over it, or just past a valley.
  bool faces(const Vec3& p, std::size_t triangle) const;
  Nearest blended(const std::vector<Side>& sides) const;

  std::vector<Vec3> points_;
  std::vector<fcl::Triangle> triangles_;
  std::vector<Vec3> normals_;                      // [triangles]
  std::vector<std::array<bool, 3>> valley_edges_;  // [triangles] indexed by the edge's first corner
  double unit_, delta_;
  std::unique_ptr<fcl::CollisionObjectd> surface_;
};

}  // namespace pulvis
