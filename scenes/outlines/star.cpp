#include "scenes/outlines/star.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "engine/portable_math.hpp"

namespace pulvis {
namespace {

// The part of a convex polygon to the left of the line from a to b.
std::vector<Vec2> cut(const std::vector<Vec2>& convex, const Vec2& a, const Vec2& b) {
  std::vector<Vec2> rest;
  for (std::size_t i = 0; i < convex.size(); ++i) {
    const Vec2 &p = convex[i], &q = convex[(i + 1) % convex.size()];
    const double side_p = cross(b - a, p - a), side_q = cross(b - a, q - a);
    if (side_p >= 0) rest.push_back(p);
    if ((side_p < 0) != (side_q < 0)) rest.push_back(p + side_p / (side_p - side_q) * (q - p));
  }
  return rest;
}

double polygon_area(const std::vector<Vec2>& polygon) {
  double twice = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i)
    twice += cross(polygon[i] - polygon[0], polygon[(i + 1) % polygon.size()] - polygon[0]);
  return twice / 2;
}

Vec2 centroid(const std::vector<Vec2>& polygon) {
  Vec2 moment = Vec2::Zero();
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    const Vec2 a = polygon[i] - polygon[0], b = polygon[i + 1] - polygon[0];
    moment += cross(a, b) / 6 * (a + b);
  }
  return polygon[0] + moment / polygon_area(polygon);
}

// Winding number of the polygon about a point.
double windings(const std::vector<Vec2>& polygon, const Vec2& centre) {
  double angle = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 a = polygon[i] - centre, b = polygon[(i + 1) % polygon.size()] - centre;
    angle += portable::atan2(cross(a, b), a.dot(b));
  }
  return angle / (2 * std::numbers::pi);
}

bool meet(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  const auto apart = [](double u, double v) { return (u > 0 && v > 0) || (u < 0 && v < 0); };
  return !apart(cross(b - a, c - a), cross(b - a, d - a)) &&
         !apart(cross(d - c, a - c), cross(d - c, b - c)) &&
         (a.cwiseMin(b).array() <= c.cwiseMax(d).array()).all() &&
         (c.cwiseMin(d).array() <= a.cwiseMax(b).array()).all();
}

}  // namespace

std::optional<Vec2> star_centre(const std::vector<Vec2>& polygon) {
  constexpr double min_share = 1e-4;  // of the area: with less it can hardly be meshed
  Vec2 low = polygon[0], high = low;
  for (const Vec2& p : polygon) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  std::vector<Vec2> kernel{low, {high.x(), low.y()}, high, {low.x(), high.y()}};
  for (std::size_t i = 0; i < polygon.size() && kernel.size() > 2; ++i)
    kernel = cut(kernel, polygon[i], polygon[(i + 1) % polygon.size()]);
  if (kernel.size() < 3 || polygon_area(kernel) < min_share * std::abs(polygon_area(polygon)))
    return {};
  const Vec2 centre = centroid(kernel);
  if (std::abs(windings(polygon, centre) - 1) > 0.5) return {};
  return centre;
}

std::optional<std::pair<std::size_t, std::size_t>> crossing_sides(
    const std::vector<Vec2>& polygon) {
  const std::size_t n = polygon.size();
  const auto end = [&](std::size_t i) { return polygon[(i + 1) % n]; };
  const auto left = [&](std::size_t i) { return std::min(polygon[i].x(), end(i).x()); };
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, left);
  for (std::size_t k = 0; k < n; ++k) {  // a sweep from left to right
    const std::size_t i = order[k];
    const double right = std::max(polygon[i].x(), end(i).x());
    for (std::size_t l = k + 1; l < n && left(order[l]) <= right; ++l) {
      const std::size_t j = order[l];
      if ((i + 1) % n == j || (j + 1) % n == i) continue;
      if (meet(polygon[i], end(i), polygon[j], end(j))) return std::minmax(i, j);
    }
  }
  return {};
}

}  // namespace pulvis
