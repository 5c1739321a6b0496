// Closed cubic splines through points, or near them.
#pragma once

#include <vector>

#include "scenes/spec/scene.hpp"

namespace pulvis {

// Periodic C2 spline whose parameter is the length of the chords between its knots.
struct ClosedSpline {
  std::vector<double> step;      // m, from each knot to the next
  std::vector<Vec2> knot, bend;  // bend: second derivative, 1/m
};
ClosedSpline closed_spline(const std::vector<Vec2>& points);

// The knots of the smoothest closed spline (least integral of its squared second derivative) whose knots lie
// `distance` from the points in the root mean square (Reinsch 1967).
std::vector<Vec2> smoothed_points(const std::vector<Vec2>& points, double distance);

}  // namespace pulvis
