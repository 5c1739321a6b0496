// Closed cubic splines that interpolate or approximate points.
#pragma once

#include <vector>

#include "scenes/spec/scene.hpp"

namespace pulvis {

// Periodic C2 spline parametrised by the chord length between its knots.
struct ClosedSpline {
  std::vector<double> step;      // m, from each knot to the next
  std::vector<Vec2> knot, bend;  // bend: second derivative, 1/m
};
ClosedSpline closed_spline(const std::vector<Vec2>& points);

// The knots of the smoothest closed spline (smallest integral of its squared second derivative) whose knots
// have an RMS distance of `distance` from the points (Reinsch 1967).
std::vector<Vec2> smoothed_points(const std::vector<Vec2>& points, double distance);

}  // namespace pulvis
