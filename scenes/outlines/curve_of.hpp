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

// m^2, as outline_area, of an outline whose curve is at hand.
double area_with(const OutlineCurve& curve, const Outline& outline);

// For any outline without a hole.
OutlineCurve any_curve(const Outline& outline);

// Corners counter-clockwise, mirrored as specified; not yet rounded, nor centred.
std::vector<Vec2> corners_of(const PolygonOutline& polygon);

// Length of a side, from the corner, that the rounding of the corner removes.
double cut_by_rounding(const Vec2& before, const Vec2& corner, const Vec2& after, double rounding);

}  // namespace pulvis
