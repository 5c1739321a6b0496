#include "scenes/outline.hpp"

#include <numbers>

namespace pulvis {
namespace {

using std::numbers::pi;

RoundedBox box_of(const DiscOutline& o) { return {Vec2::Zero(), o.diameter / 2}; }
RoundedBox box_of(const RectangleOutline& o) { return {Vec2(o.width, o.height) / 2, 0}; }
RoundedBox box_of(const RoundedRectangleOutline& o) {
  return {Vec2(o.width, o.height) / 2 - Vec2::Constant(o.radius), o.radius};
}
RoundedBox box_of(const RingOutline& o) { return {Vec2::Zero(), o.diameter / 2}; }

double area_of(const DiscOutline& o) { return pi / 4 * o.diameter * o.diameter; }
double area_of(const RectangleOutline& o) { return o.width * o.height; }
double area_of(const RoundedRectangleOutline& o) {
  return o.width * o.height - (4 - pi) * o.radius * o.radius;
}
double area_of(const RingOutline& o) {
  return pi / 4 * (o.diameter * o.diameter - o.hole * o.hole);
}

}  // namespace

RoundedBox rounded_box(const Outline& outline) {
  return std::visit([](const auto& o) { return box_of(o); }, outline);
}

double outline_area(const Outline& outline) {
  return std::visit([](const auto& o) { return area_of(o); }, outline);
}

}  // namespace pulvis
