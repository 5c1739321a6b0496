// Outlines as rigid bodies, for packing: convex pieces, each a polygon plus all points within a radius
// of it. A disc is one point with a radius, a rounded rectangle a rectangle with one.
#pragma once

#include "scenes/outlines/portable.hpp"
#include "scenes/spec/scene.hpp"

#include <vector>

namespace pulvis {

struct RigidPiece {
  std::vector<portable::V2> corners;  // counter-clockwise; one for a disc, two for a stadium
  std::vector<portable::V2>
      normals;  // outward, of the side from a corner to the next; none for a point
  double radius = 0;
  portable::V2 centre;  // of a circle around the piece
  double reach = 0;     // its radius
  double inside = 0;    // radius of a circle about the centre that no side cuts
  bool operator==(const RigidPiece&) const = default;
};

struct RigidShape {
  std::vector<RigidPiece> pieces;
  portable::V2
      centroid;      // of the outline, in the outline's local frame; the pieces are relative to it
  double reach = 0;  // distance of the farthest point from the centroid
  double content = 0;    // area of the outline without holes: what no other particle can enter
  double gyration = 0;   // square of the radius of gyration about the centroid
  double diameter = 0;   // of the disc of the same area
  double min_width = 0;  // between two parallel lines
  bool operator==(const RigidShape&) const = default;
};

// For an outline that is not a rounded box, the pieces either contain it, extending beyond it by at most
// `deviation`, or lie inside.
enum class Fit { around, inside };

// In units of `unit` (m). `deviation` (m) is larger where an outline would need too many corners.
RigidShape rigid_shape(const Outline& outline, double unit, double deviation,
                       Fit fit = Fit::around);

}  // namespace pulvis
