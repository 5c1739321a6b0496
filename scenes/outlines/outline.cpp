#include "scenes/outlines/outline.hpp"
#include "scenes/outlines/curve_of.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/portable_math.hpp"
#include "scenes/outlines/outline_curve.hpp"

namespace pulvis {
namespace {

using std::numbers::pi;

using Box = std::optional<RoundedBox>;

Box box_of(const DiscOutline& o) { return RoundedBox{Vec2::Zero(), o.diameter / 2}; }
Box box_of(const RectangleOutline& o) { return RoundedBox{Vec2(o.width, o.height) / 2, 0}; }
Box box_of(const RoundedRectangleOutline& o) {
  return RoundedBox{Vec2(o.width, o.height) / 2 - Vec2::Constant(o.radius), o.radius};
}
Box box_of(const RingOutline& o) { return RoundedBox{Vec2::Zero(), o.diameter / 2}; }
template <class CurvedOutline>
Box box_of(const CurvedOutline&) {
  return {};
}

double area_of(const DiscOutline& o) { return pi / 4 * o.diameter * o.diameter; }
double area_of(const RectangleOutline& o) { return o.width * o.height; }
double area_of(const RoundedRectangleOutline& o) {
  return o.width * o.height - (4 - pi) * o.radius * o.radius;
}
double area_of(const RingOutline& o) {
  return pi / 4 * (o.diameter * o.diameter - o.hole * o.hole);
}

double area_of(const EllipseOutline& o) { return pi / 4 * o.width * o.height; }
double area_of(const SuperellipseOutline& o) {
  const double g = portable::log_gamma(1 + 1 / o.exponent),
               h = portable::log_gamma(1 + 2 / o.exponent);
  return o.width * o.height * portable::exp(2 * g - h);
}

std::vector<Vec2> polygon_of(const RoundedBox& box, double deviation) {
  // The sagitta of a chord over the angle 2 a is r (1 - cos a).
  const double share = std::clamp(deviation / std::max(box.radius, deviation), 0.0, 1.0);
  const int chords =
      box.radius > 0 ? static_cast<int>(std::ceil(pi / 4 / portable::acos(1 - share))) : 0;
  std::vector<Vec2> points;
  for (int corner = 0; corner < 4; ++corner) {
    const Vec2 centre(corner % 3 == 0 ? box.half.x() : -box.half.x(),
                      corner < 2 ? box.half.y() : -box.half.y());
    // Where the box has zero size along a side, the arc after it starts where this one ends.
    const bool meets_next = chords > 0 && (corner % 2 == 0 ? box.half.x() : box.half.y()) == 0;
    for (int i = 0; i <= chords - (meets_next ? 1 : 0); ++i) {
      const double angle = pi / 2 * (corner + (chords > 0 ? static_cast<double>(i) / chords : 0));
      points.push_back(centre + box.radius * Vec2(portable::cos(angle), portable::sin(angle)));
    }
  }
  return points;
}

}  // namespace

std::optional<RoundedBox> rounded_box(const Outline& outline) {
  return std::visit([](const auto& o) { return box_of(o); }, outline);
}

std::vector<Vec2> outline_polygon(const Outline& outline, double deviation) {
  return std::visit(
      [&](const auto& o) {
        if constexpr (requires { curve_of(o); })
          return curve_of(o).polygon(deviation);
        else
          return polygon_of(*box_of(o), deviation);
      },
      outline);
}

bool has_notch(const Outline& outline) {
  constexpr double deviation = 1e-3, round_off = 1e-9;
  const auto points = outline_polygon(outline, deviation * std::sqrt(outline_area(outline)));
  for (std::size_t i = 0, n = points.size(); i < n; ++i) {
    const Vec2 a = points[(i + 1) % n] - points[i], b = points[(i + 2) % n] - points[(i + 1) % n];
    if (a.x() * b.y() - a.y() * b.x() < -round_off * a.norm() * b.norm()) return true;
  }
  return false;
}

bool can_fold(const Outline& outline) {
  constexpr double slender =
      4;  // length over width: bent into a ring, its fibres are strained by pi / 4
  const double area = outline_area(outline);
  double longest = 0;
  for (const Vec2& p : outline_polygon(outline, 0.1 * std::sqrt(area)))
    longest = std::max(longest, 2 * p.norm());
  return longest * longest > slender * area || has_notch(outline);
}

double outline_area(const Outline& outline) {
  return std::visit(
      [](const auto& o) {
        if constexpr (requires { area_of(o); })
          return area_of(o);
        else
          return curve_of(o).area();
      },
      outline);
}

double area_with(const OutlineCurve& curve, const Outline& outline) {
  return std::visit(
      [&](const auto& o) {
        if constexpr (requires { area_of(o); })
          return area_of(o);
        else
          return curve.area();
      },
      outline);
}

}  // namespace pulvis
