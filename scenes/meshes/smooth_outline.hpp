// Boundary nodes and smoothing of a round outline, chosen so that the mesh's polygon has the outline's
// area, and the contact curve lies on the outline.
#pragma once

#include <vector>

#include "components/shape.hpp"

namespace pulvis {

// Position of a boundary node on the true outline, counter-clockwise.
struct OutlinePoint {
  Point at;
  Point normal;  // outward
  double bulge;  // m^2, between the chord to the next point and the outline
};

struct SmoothOutline {
  std::vector<Point> nodes;
  std::vector<double> c;  // of the contact curve (scenes/meshes/contact_curve.hpp), about 1/12
};

// `d` is the fourth-difference coefficient of the contact curve, which its c has to allow for.
SmoothOutline smooth_outline(const std::vector<OutlinePoint>& points, double area, double d);

// Points on the rectangle of `size` with rounded corners (a disc when both sides are twice the radius),
// side after side (bottom, right, top, left), each from the middle of one arc to the middle of the next.
// `stations` of the horizontal and vertical sides: positions of their nodes, as arc length over that of
// half the side, ascending from -1 to 1, mirror-symmetric.
std::vector<OutlinePoint> rounded_points(const Point& size, double radius,
                                         const std::vector<double>& horizontal,
                                         const std::vector<double>& vertical);

}  // namespace pulvis
