#include "scenes/packing/outlines/rigid_shape.hpp"
#include "scenes/packing/outlines/convex_pieces.hpp"

#include <algorithm>
#include <limits>
#include <numbers>

#include "scenes/language/vectors.hpp"
#include "scenes/outlines/outline.hpp"

namespace pulvis {
namespace {

using portable::V2;

constexpr std::size_t max_corners = 240;

// Corners computed with a library's sine may differ in their last bits: on this grid they do not.
V2 on_grid(V2 p) {
  constexpr double grid = 0x1p-34;
  return {grid * std::round(p.x / grid), grid * std::round(p.y / grid)};
}

struct Moments {  // of area
  double area = 0;
  V2 first;
  double polar = 0;  // about the origin
};

// From triangles with the origin (Green's theorem).
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
  piece.inside = piece.normals.empty() ? 0 : std::numeric_limits<double>::max();
  for (std::size_t i = 0; i < piece.normals.size(); ++i)
    piece.inside =
        std::min(piece.inside, portable::dot(piece.normals[i], piece.corners[i] - piece.centre));
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

// The minimum is normal to a side of the convex hull; the sides of the pieces and a fan of directions
// approximate it well enough for the purpose: whether a particle fits into its die.
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
  shape.content = moments.area;
  shape.centroid = (1 / moments.area) * moments.first;
  shape.gyration = moments.polar / moments.area - portable::dot(shape.centroid, shape.centroid);
  shape.diameter = std::sqrt(4 / std::numbers::pi * shape.content);
  for (RigidPiece& piece : shape.pieces) {
    for (V2& corner : piece.corners) {
      corner = corner - shape.centroid;
      shape.reach = std::max(shape.reach, portable::length(corner) + piece.radius);
    }
    piece.centre = piece.centre - shape.centroid;
  }
  shape.min_width = min_width(shape);
}

// Whether no corner in between is farther than `deviation` from the side that connects the two.
bool is_near(const std::vector<Vec2>& corners, std::size_t from, std::size_t to, double deviation) {
  const Vec2 a = corners[from], along = corners[to % corners.size()] - a;
  const double length = along.norm();
  for (std::size_t i = from + 1; i < to; ++i) {
    const Vec2 arm = corners[i] - a;
    const double ahead = arm.dot(along) / length;
    if (!(ahead > 0 && ahead < length && std::abs(pulvis::cross(along, arm)) / length <= deviation))
      return false;
  }
  return true;
}

std::vector<Vec2> thinned(const std::vector<Vec2>& corners, double deviation) {
  std::vector<Vec2> kept;
  for (std::size_t from = 0, to = 0; from < corners.size(); from = to) {
    kept.push_back(corners[from]);
    to = from + 1;
    while (to < corners.size() && is_near(corners, from, to + 1, deviation)) ++to;
  }
  return kept;
}

// With few enough corners: `deviation` grows as needed.
std::vector<Vec2> rigid_polygon(const Outline& outline, double& deviation) {
  std::vector<Vec2> points = outline_polygon(outline, deviation);
  for (; points.size() > max_corners; deviation *= 2) {
    std::vector<Vec2> coarser = outline_polygon(outline, 2 * deviation);
    // A curve through many points keeps a corner at each, however coarse.
    if (coarser.size() == points.size()) coarser = thinned(points, deviation);
    points = std::move(coarser);
  }
  return points;
}

}  // namespace

RigidShape rigid_shape(const Outline& outline, double unit, double deviation, Fit fit) {
  std::vector<V2> polygon;
  for (const Vec2& p : rigid_polygon(outline, deviation))
    polygon.push_back(on_grid({p.x() / unit, p.y() / unit}));
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
