// The curves of the outlines that are defined by a formula, by corners or by points.
#include "scenes/outlines/curve_of.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "engine/portable_math.hpp"
#include "scenes/outlines/closed_spline.hpp"
#include "scenes/spec/rotation.hpp"

namespace pulvis {
namespace {

using std::numbers::pi;
using Point = OutlineCurve::Point;
using Piece = OutlineCurve::Piece;

Piece flat(const Vec2& from, const Vec2& to) {
  return [=](double t) { return Point{from + t * (to - from), to - from}; };
}

// A quarter of a superellipse over the polar angle of (x/a, y/b): smooth at its ends for any exponent > 1.
Point on_superellipse(const SuperellipseOutline& o, int quarter, double t) {
  const double angle = pi / 2 * t, n = o.exponent;
  const double c = portable::cos(angle), s = portable::sin(angle);
  const double sum = portable::pow(c, n) + portable::pow(s, n);
  const double radius = portable::pow(sum, -1 / n);
  const double slope = -radius / sum * (c * portable::pow(s, n - 1) - s * portable::pow(c, n - 1));
  Vec2 at(radius * c, radius * s), rate(slope * c - radius * s, slope * s + radius * c);
  rate *= pi / 2;
  for (int turn = 0; turn < quarter; ++turn) {
    at = {-at.y(), at.x()};
    rate = {-rate.y(), rate.x()};
  }
  const Vec2 half(o.width / 2, o.height / 2);
  return {at.cwiseProduct(half), rate.cwiseProduct(half)};
}

// The arc that rounds a corner, over the part from `from` to `to` of its turning angle.
Piece arc(const Vec2& before, const Vec2& corner, const Vec2& after, double rounding, double from,
          double to) {
  const Vec2 in = (corner - before).normalized(), out = (after - corner).normalized();
  const double turn = portable::atan2(cross(in, out), in.dot(out));
  const double side = turn < 0 ? -1 : 1;  // the centre lies to the left of a convex corner
  const Vec2 start = corner - cut_by_rounding(before, corner, after, rounding) * in;
  const Vec2 arm(in.y() * side * rounding, -in.x() * side * rounding);  // from the centre
  const Vec2 centre = start - arm;
  return [=](double t) {
    const Vec2 here = rotation(turn * (from + t * (to - from))) * arm;
    return Point{centre + here, turn * (to - from) * Vec2(-here.y(), here.x())};
  };
}

double signed_area(const std::vector<Vec2>& corners) {
  double twice = 0;
  for (std::size_t i = 0; i < corners.size(); ++i)
    twice += cross(corners[i], corners[(i + 1) % corners.size()]);
  return twice / 2;
}

std::vector<Vec2> counter_clockwise(std::vector<Vec2> points, bool mirrored) {
  if (mirrored)
    for (Vec2& p : points) p.x() = -p.x();
  if (signed_area(points) < 0) std::reverse(points.begin() + 1, points.end());
  return points;
}

std::vector<Vec2> regular(int sides, double diameter) {
  std::vector<Vec2> corners;
  for (int i = 0; i < sides; ++i) {
    const double angle = -pi / 2 + pi / sides * (2 * i - 1);
    corners.push_back(diameter / 2 * Vec2(portable::cos(angle), portable::sin(angle)));
  }
  return corners;
}

}  // namespace

std::vector<Vec2> corners_of(const PolygonOutline& polygon) {
  return counter_clockwise(
      polygon.sides > 0 ? regular(polygon.sides, polygon.diameter) : polygon.corners,
      polygon.mirrored);
}

double cut_by_rounding(const Vec2& before, const Vec2& corner, const Vec2& after, double rounding) {
  const Vec2 in = (corner - before).normalized(), out = (after - corner).normalized();
  return rounding * portable::tan(0.5 * std::abs(portable::atan2(cross(in, out), in.dot(out))));
}

OutlineCurve curve_of(const EllipseOutline& outline) {
  const Vec2 half(outline.width / 2, outline.height / 2);
  std::vector<Piece> pieces;
  for (int quarter = 0; quarter < 4; ++quarter)
    pieces.push_back([=](double t) {
      const double angle = pi / 2 * (quarter + t), c = portable::cos(angle),
                   s = portable::sin(angle);
      return Point{half.cwiseProduct(Vec2(c, s)), pi / 2 * half.cwiseProduct(Vec2(-s, c))};
    });
  return {std::move(pieces), false};
}

OutlineCurve curve_of(const SuperellipseOutline& outline) {
  std::vector<Piece> pieces;
  for (int quarter = 0; quarter < 4; ++quarter)
    pieces.push_back([=](double t) { return on_superellipse(outline, quarter, t); });
  return {std::move(pieces), false};
}

OutlineCurve curve_of(const PolygonOutline& outline) {
  const std::vector<Vec2> corners = corners_of(outline);
  const std::size_t n = corners.size();
  const double r = outline.rounding;
  const auto corner = [&](std::size_t i) { return corners[i % n]; };
  std::vector<Piece> pieces;
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 a = corner(i + n - 1), b = corner(i), c = corner(i + 1), d = corner(i + 2);
    const Vec2 along = (c - b).normalized();
    const double from = cut_by_rounding(a, b, c, r), to = cut_by_rounding(b, c, d, r);
    if (r > 0) pieces.push_back(arc(a, b, c, r, 0.5, 1));
    // Adjacent roundings that meet leave no flat.
    if (from + to < (1 - 1e-9) * (c - b).norm())
      pieces.push_back(flat(b + from * along, c - to * along));
    if (r > 0) pieces.push_back(arc(b, c, d, r, 0, 0.5));
  }
  return {std::move(pieces), r == 0};
}

OutlineCurve curve_of(const PointsOutline& outline) {
  const ClosedSpline spline = closed_spline(counter_clockwise(outline.points, outline.mirrored));
  const std::size_t n = spline.knot.size();
  std::vector<Piece> pieces;
  for (std::size_t i = 0; i < n; ++i)
    pieces.push_back([h = spline.step[i], p = spline.knot[i], q = spline.knot[(i + 1) % n],
                      a = spline.bend[i], b = spline.bend[(i + 1) % n]](double t) {
      const double u = 1 - t, w = h * h / 6;
      return Point{u * p + t * q + w * ((u * u * u - u) * a + (t * t * t - t) * b),
                   q - p + w * ((1 - 3 * u * u) * a + (3 * t * t - 1) * b)};
    });
  OutlineCurve curve(pieces, false);
  double scale = 1;
  if (outline.width) scale = *outline.width / curve.extent().x();
  if (outline.diameter) scale = *outline.diameter / (2 * std::sqrt(curve.area() / pi));
  if (outline.area) scale = std::sqrt(*outline.area / curve.area());
  return scale == 1 ? curve : OutlineCurve(std::move(pieces), false, scale);
}

OutlineCurve curve_of(const GrainOutline& outline) {
  std::vector<Piece> pieces;
  const std::size_t n = outline.faces.size();
  for (std::size_t i = 0; i < n; ++i) {
    const GrainOutline::Face& face = outline.faces[i];
    if (face.on_outline())
      pieces.push_back([particle = outline.particle, face](double t) {
        const double length = face.end - face.begin, round = particle->length();
        const auto place = particle->at(std::fmod(face.begin + t * length, round));
        return Point{place.at, length * Vec2(-place.normal.y(), place.normal.x())};
      });
    else
      pieces.push_back(flat(face.from, outline.faces[(i + 1) % n].from));
  }
  return {std::move(pieces), true};
}

OutlineCurve any_curve(const Outline& outline) {
  if (const auto* disc = std::get_if<DiscOutline>(&outline))
    return curve_of(EllipseOutline{disc->diameter, disc->diameter});
  const auto box = [](double width, double height, double rounding) {
    const Vec2 half(width / 2, height / 2), other(-half.x(), half.y());
    return curve_of(PolygonOutline{.corners = {-half, -other, half, other}, .rounding = rounding});
  };
  if (const auto* o = std::get_if<RectangleOutline>(&outline)) return box(o->width, o->height, 0);
  if (const auto* o = std::get_if<RoundedRectangleOutline>(&outline))
    return box(o->width, o->height, o->radius);
  return std::visit(
      [](const auto& o) {
        if constexpr (requires { curve_of(o); }) return curve_of(o);
        throw std::logic_error("no curve with a hole");
        return curve_of(EllipseOutline{});
      },
      outline);
}

}  // namespace pulvis
