#include "scenes/outlines/scaled_outline.hpp"

namespace pulvis {
namespace {

DiscOutline scaled_by(double f, const DiscOutline& o) { return {f * o.diameter}; }
RectangleOutline scaled_by(double f, const RectangleOutline& o) {
  return {f * o.width, f * o.height};
}
RoundedRectangleOutline scaled_by(double f, const RoundedRectangleOutline& o) {
  return {f * o.width, f * o.height, f * o.radius};
}
RingOutline scaled_by(double f, const RingOutline& o) { return {f * o.diameter, f * o.hole}; }
EllipseOutline scaled_by(double f, const EllipseOutline& o) { return {f * o.width, f * o.height}; }
SuperellipseOutline scaled_by(double f, const SuperellipseOutline& o) {
  return {f * o.width, f * o.height, o.exponent};
}
PolygonOutline scaled_by(double f, PolygonOutline o) {
  o.diameter *= f;
  for (Vec2& corner : o.corners) corner *= f;
  o.rounding *= f;
  return o;
}
PointsOutline scaled_by(double f, PointsOutline o) {
  for (Vec2& point : o.points) point *= f;
  o.smoothing *= f;
  if (o.width) *o.width *= f;
  if (o.diameter) *o.diameter *= f;
  if (o.area) *o.area *= f * f;
  return o;
}
FourierOutline scaled_by(double f, FourierOutline o) {
  o.diameter *= f;
  return o;
}

// Particles are scaled before they are cut into grains.
GrainOutline scaled_by(double, const GrainOutline& o) { return o; }

}  // namespace

Outline scaled(const Outline& outline, double factor) {
  return std::visit([factor](const auto& o) -> Outline { return scaled_by(factor, o); }, outline);
}

}  // namespace pulvis
