// Outlines as curves.
#pragma once

#include <vector>
#include "scenes/outlines/outline_curve.hpp"

namespace pulvis {

// The curve of an ellipse, superellipse, polygon, traced or irregular outline.
OutlineCurve curve_of(const EllipseOutline& outline);
OutlineCurve curve_of(const SuperellipseOutline& outline);
OutlineCurve curve_of(const PolygonOutline& outline);
OutlineCurve curve_of(const PointsOutline& outline);
OutlineCurve curve_of(const FourierOutline& outline);
OutlineCurve curve_of(const GrainOutline& outline);

// Of any outline without a hole.
OutlineCurve any_curve(const Outline& outline);

// Corners counter-clockwise, as mirrored as it says; not yet rounded, nor moved to the centre.
std::vector<Vec2> corners_of(const PolygonOutline& polygon);

// How much of a side the rounding of a corner takes, as length from the corner.
double cut_by_rounding(const Vec2& before, const Vec2& corner, const Vec2& after, double rounding);

}  // namespace pulvis
