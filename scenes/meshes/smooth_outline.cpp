#include "scenes/meshes/smooth_outline.hpp"

#include <cmath>
#include <numbers>

#include "engine/portable_math.hpp"

namespace pulvis {
namespace {

double cross(const Point& a, const Point& b) { return a[0] * b[1] - a[1] * b[0]; }
double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1]; }
double distance(const Point& a, const Point& b) {
  return portable::hypot(b[0] - a[0], b[1] - a[1]);
}

double angle_between(const Point& a, const Point& b) {
  return std::abs(portable::atan2(cross(a, b), dot(a, b)));
}

// On an even arc with the angle theta to both neighbours, whose nodes lie at radius r for the polygon's
// area, a curve with knots at the nodes passes at r ((4 + 2 cos theta)/6) (1 + 2 c w + 4 d w^2) with
// w = 1 - cos theta; this c makes it 1. Elsewhere theta is the mean of both sides.
double arc_smoothing(double theta, double d) {
  const double w = 1 - portable::cos(theta);
  if (w < 1e-8) return 1.0 / 12;  // the limit, where round-off would dominate
  const double r = std::sqrt(theta / portable::sin(theta));
  return (6 / (r * (4 + 2 * portable::cos(theta))) - 1 - 4 * d * w * w) / (2 * w);
}

// f such that the polygon through at + f shift has this area: the area is a + b f + q f^2.
double shift_factor(const std::vector<OutlinePoint>& points, const std::vector<double>& shift,
                    double area) {
  double a = -area, b = 0, q = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::size_t j = (i + 1) % points.size();
    a += 0.5 * cross(points[i].at, points[j].at);
    b += 0.5 * (shift[j] * cross(points[i].at, points[j].normal) +
                shift[i] * cross(points[i].normal, points[j].at));
    q += 0.5 * shift[i] * shift[j] * cross(points[i].normal, points[j].normal);
  }
  return -2 * a / (b + std::sqrt(b * b - 4 * a * q));
}

// Half a side from its middle to the middle of the arc; mirrored for s < 0.
struct HalfSide {
  double flat, radius;  // length of the half flat, m
  double length() const { return flat + radius * std::numbers::pi / 4; }
  double turn(double s) const {
    return radius > 0 ? std::max(std::abs(s) - flat, 0.0) / radius : 0;
  }
  // Along the side, and the distance inside the flat.
  Point at(double s) const {
    const double along = std::min(std::abs(s), flat) + radius * portable::sin(turn(s));
    return {s < 0 ? -along : along, radius * (1 - portable::cos(turn(s)))};
  }
  Point normal(double s) const {
    return {s < 0 ? -portable::sin(turn(s)) : portable::sin(turn(s)), -portable::cos(turn(s))};
  }
  // Area between the chord from s to t and the side: the polygon over the ends of the flat, and the
  // segments of the arcs.
  double bulge(double s, double t) const {
    const Point origin = at(s);
    Point before{};
    double from = s, area = 0;
    for (const double to : {-flat, flat, t}) {
      if (to <= from || to > t) continue;
      const double theta = std::abs(turn(to) - turn(from));
      const Point p = at(to), here{p[0] - origin[0], p[1] - origin[1]};
      area += 0.5 * cross(before, here) + 0.5 * radius * radius * (theta - portable::sin(theta));
      before = here;
      from = to;
    }
    return area;
  }
};

Point quarter_turns(Point p, int turns) {
  for (; turns > 0; --turns) p = {-p[1], p[0]};
  return p;
}

}  // namespace

SmoothOutline smooth_outline(const std::vector<OutlinePoint>& points, double area, double d) {
  const std::size_t n = points.size();
  // When a node moves, its two edges each sweep half their length: this shift makes up for half of each
  // area that they cut off. One common factor makes the sum exact, since it falls slightly short.
  std::vector<double> shift(n);
  SmoothOutline outline;
  for (std::size_t i = 0; i < n; ++i) {
    const OutlinePoint &before = points[(i + n - 1) % n], &here = points[i],
                       &after = points[(i + 1) % n];
    shift[i] =
        (before.bulge + here.bulge) / (distance(before.at, here.at) + distance(here.at, after.at));
    outline.c.push_back(arc_smoothing(0.5 * (angle_between(before.normal, here.normal) +
                                             angle_between(here.normal, after.normal)),
                                      d));
  }
  const double factor = shift_factor(points, shift, area);
  for (std::size_t i = 0; i < n; ++i)
    outline.nodes.push_back({points[i].at[0] + factor * shift[i] * points[i].normal[0],
                             points[i].at[1] + factor * shift[i] * points[i].normal[1]});
  return outline;
}

std::vector<OutlinePoint> rounded_points(const Point& size, double radius,
                                         const std::vector<double>& horizontal,
                                         const std::vector<double>& vertical) {
  std::vector<OutlinePoint> points;
  for (int side = 0; side < 4; ++side) {
    const std::size_t along = side % 2 == 0 ? 0 : 1;
    const std::vector<double>& stations = along == 0 ? horizontal : vertical;
    const HalfSide half{0.5 * size[along] - radius, radius};
    for (std::size_t i = 0; i + 1 < stations.size(); ++i) {
      const double s = stations[i] * half.length(), t = stations[i + 1] * half.length();
      const Point p = half.at(s);
      points.push_back({quarter_turns({p[0], p[1] - 0.5 * size[1 - along]}, side),
                        quarter_turns(half.normal(s), side), half.bulge(s, t)});
    }
  }
  return points;
}

}  // namespace pulvis
