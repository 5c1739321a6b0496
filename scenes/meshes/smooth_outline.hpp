// Boundary nodes and smoothing of a round outline: what makes the mesh's polygon have the outline's area,
// and the contact curve lie on the outline.
#pragma once

#include <vector>

#include "components/shape.hpp"

namespace pulvis {

// Where a boundary node belongs on the true outline, counter-clockwise.
struct OutlinePoint {
  Point at;
  Point normal;  // outward
  double bulge;  // m^2, between the chord to the next point and the outline
};

struct SmoothOutline {
  std::vector<Point> nodes;
  std::vector<double> c;  // of the contact curve (scenes/meshes/contact_curve.hpp), about 1/12
};

// `d` is the fourth difference of the contact curve, which its c has to allow for.
SmoothOutline smooth_outline(const std::vector<OutlinePoint>& points, double area, double d);

// Points of the rectangle of `size` with rounded corners (a disc when both sides are twice the radius),
// side after side (bottom, right, top, left), each from the middle of one arc to the middle of the next.
// `stations` of the horizontal and vertical sides: where their nodes stand, as arc length over that of
// half the side, rising from -1 to 1, mirror-symmetric.
std::vector<OutlinePoint> rounded_points(const Point& size, double radius,
                                         const std::vector<double>& horizontal,
                                         const std::vector<double>& vertical);

}  // namespace pulvis
