#include "scenes/packing/rigid_shape.hpp"
#include "scenes/packing/convex_pieces.hpp"

#include <algorithm>
#include <limits>
#include <numbers>

#include "scenes/outlines/outline.hpp"

namespace pulvis {
namespace {

using portable::V2;

constexpr std::size_t max_corners = 240;

// Corners that came from a library's sine may differ in their last bits: on this grid they do not.
V2 on_grid(V2 p) {
  constexpr double grid = 0x1p-34;
  return {grid * std::round(p.x / grid), grid * std::round(p.y / grid)};
}

struct Moments {  // of area
  double area = 0;
  V2 first;
  double polar = 0;  // about the origin
};

// By triangles with the origin (Green's theorem).
Moments moments_of(const std::vector<V2>& polygon) {
  Moments m;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const V2 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
    const double twice = portable::cross(a, b);
    m.area += twice / 2;
    m.first = m.first + (twice / 6) * (a + b);
    m.polar += twice / 12 * (portable::dot(a, a) + portable::dot(a, b) + portable::dot(b, b));
  }
  return m;
}

void enclose(RigidPiece& piece) {
  for (const V2 corner : piece.corners)
    piece.centre = piece.centre + (1.0 / static_cast<double>(piece.corners.size())) * corner;
  for (const V2 corner : piece.corners)
    piece.reach = std::max(piece.reach, portable::length(corner - piece.centre));
  piece.reach += piece.radius;
}

RigidPiece piece_of(std::vector<V2> corners, double radius) {
  RigidPiece piece;
  piece.corners = std::move(corners);
  piece.radius = radius;
  for (std::size_t i = 0; piece.corners.size() > 1 && i < piece.corners.size(); ++i) {
    const V2 side = piece.corners[(i + 1) % piece.corners.size()] - piece.corners[i];
    piece.normals.push_back((1 / portable::length(side)) * V2{side.y, -side.x});
  }
  enclose(piece);
  return piece;
}

RigidPiece rounded(const RoundedBox& box, double unit) {
  const double x = box.half.x() / unit, y = box.half.y() / unit;
  std::vector<V2> corners{{-x, -y}, {x, -y}, {x, y}, {-x, y}};
  if (y == 0) corners = {{-x, 0}, {x, 0}};
  if (x == 0) corners = {{0, -y}, {0, y}};
  if (x == 0 && y == 0) corners = {{0, 0}};
  return piece_of(std::move(corners), box.radius / unit);
}

double width_along(const RigidShape& shape, V2 n) {
  double low = std::numeric_limits<double>::max(), high = -low;
  for (const RigidPiece& piece : shape.pieces)
    for (const V2 corner : piece.corners) {
      low = std::min(low, portable::dot(n, corner) - piece.radius);
      high = std::max(high, portable::dot(n, corner) + piece.radius);
    }
  return high - low;
}

// The least one is square to a side of the convex hull; the sides of the pieces and a fan of directions
// come near enough to it for what this is asked: whether a particle fits into its die.
double min_width(const RigidShape& shape) {
  constexpr int fan = 64;
  double minimum = std::numeric_limits<double>::max();
  portable::Turn direction;
  for (int i = 0; i < fan; ++i) {
    minimum = std::min(minimum, width_along(shape, {direction.c, direction.s}));
    direction = portable::turned(direction, std::numbers::pi / fan / 2);
  }
  for (const RigidPiece& piece : shape.pieces)
    for (const V2 normal : piece.normals) minimum = std::min(minimum, width_along(shape, normal));
  return minimum;
}

void measure(RigidShape& shape, const Moments& moments) {
  shape.area = moments.area;
  shape.centroid = (1 / moments.area) * moments.first;
  shape.gyration = moments.polar / moments.area - portable::dot(shape.centroid, shape.centroid);
  shape.diameter = std::sqrt(4 / std::numbers::pi * shape.area);
  for (RigidPiece& piece : shape.pieces) {
    for (V2& corner : piece.corners) {
      corner = corner - shape.centroid;
      shape.reach = std::max(shape.reach, portable::length(corner) + piece.radius);
    }
    piece.centre = piece.centre - shape.centroid;
  }
  shape.min_width = min_width(shape);
}

// Leaves out corners that lie within `tolerance` of the side that is left in their place.
std::vector<Vec2> thinned(const std::vector<Vec2>& points, double tolerance) {
  const auto distance = [](const Vec2& p, const Vec2& a, const Vec2& b) {
    const Vec2 along = b - a;
    const double share = std::clamp((p - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
    return (p - a - share * along).norm();
  };
  const auto replaces = [&](std::size_t from, std::size_t to) {  // the side all corners between
    for (std::size_t i = from + 1; i < to; ++i)
      if (distance(points[i], points[from], points[to]) > tolerance) return false;
    return true;
  };
  std::vector<Vec2> kept;
  for (std::size_t from = 0, to = 0; from < points.size(); from = to) {
    kept.push_back(points[from]);
    for (to = from + 1; to + 1 < points.size() && replaces(from, to + 1);) ++to;
  }
  return kept;
}

// The polygon of an outline, as much coarser as the cost of contacts asks for. Its curve has a corner at least where a
// piece begins: where the pieces alone are too many, as of a curve through many points, corners are left out.
std::vector<Vec2> few_corners(const Outline& outline, double& deviation) {
  std::vector<Vec2> points = outline_polygon(outline, deviation);
  if (points.size() <= max_corners) return points;
  const double any = 1e3 * points[0].norm() + 1e3 * (points[1] - points[0]).norm();
  if (outline_polygon(outline, any).size() > max_corners) {
    const std::vector<Vec2> all = points;
    double tolerance = deviation;
    for (; points.size() > max_corners; tolerance *= 2) points = thinned(all, tolerance);
    deviation += tolerance / 2;
    return points;
  }
  for (; points.size() > max_corners; points = outline_polygon(outline, deviation)) deviation *= 2;
  return points;
}

}  // namespace

RigidShape rigid_shape(const Outline& outline, double unit, double deviation, Fit fit) {
  const std::vector<Vec2> points = few_corners(outline, deviation);
  std::vector<V2> polygon;
  for (const Vec2& p : points) polygon.push_back(on_grid({p.x() / unit, p.y() / unit}));
  RigidShape shape;
  const double radius = fit == Fit::around ? deviation / unit : 0;
  if (const auto box = rounded_box(outline))
    shape.pieces.push_back(rounded(*box, unit));
  else
    for (std::vector<V2>& corners : convex_pieces(polygon))
      shape.pieces.push_back(piece_of(std::move(corners), radius));
  measure(shape, moments_of(polygon));
  return shape;
}

}  // namespace pulvis
