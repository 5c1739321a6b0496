#include "scenes/tools/surface.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "engine/portable_math.hpp"
#include "scenes/spec/rotation.hpp"
#include "systems/contact/surface_search.hpp"

namespace pulvis {
namespace {

using Piece = ToolSurface::Piece;

constexpr double straight_on = 1e-12;      // sine of a turn that counts as round-off
constexpr double chain_round_off = 1e-12;  // of the chain's size
constexpr double endless = std::numeric_limits<double>::infinity();

Vec2 left_of(const Vec2& t) { return {-t.y(), t.x()}; }

struct Corner {
  double tangent = 0;  // m, from the corner to the start of the arc
  double side = 0;
};

// With the powder to the left, a turn to the right points into it.
Corner corner_between(const Vec2& t, const Vec2& next, double rounding) {
  const double turn = cross(t, next);
  if (std::abs(turn) < straight_on) return {};
  if (turn > 0) return {0, -1};
  return {rounding * -turn / (1 + t.dot(next)), 1};  // tan of half the turn
}

std::vector<Vec2> directions(const std::vector<Vec2>& points) {
  std::vector<Vec2> result;
  for (std::size_t i = 0; i + 1 < points.size(); ++i)
    result.push_back((points[i + 1] - points[i]).normalized());
  return result;
}

double chain_size(const std::vector<Vec2>& points) {
  double size = 0;
  for (const Vec2& p : points) size = std::max(size, (p - points.front()).norm());
  return size;
}

// Whether and where two straight segments p + s t and q + u w intersect; parallel ones only if they are
// collinear and share points.
bool meet(const Vec2& p, const Vec2& t, double low, double high, const Vec2& q, const Vec2& w,
          double from, double to) {
  const double sine = cross(t, w);
  const Vec2 apart = q - p;
  if (std::abs(sine) < straight_on) {
    const double distance = std::abs(cross(t, apart));
    if (distance > chain_round_off * (apart.norm() + 1e-300)) return false;
    const double sign = t.dot(w) > 0 ? 1 : -1, begin = t.dot(apart);
    const double one = begin + sign * from, other = begin + sign * to;
    return std::min(one, other) <= high && std::max(one, other) >= low;
  }
  const double s = cross(apart, w) / sine, u = cross(apart, t) / sine;
  return s >= low && s <= high && u >= from && u <= to;
}

std::string crossing_fault(const std::vector<Vec2>& points, const std::vector<Vec2>& t) {
  const std::size_t count = t.size();
  const auto goes_on = [](const Vec2& direction) { return direction.x() > 0; };
  if (std::ranges::all_of(t, goes_on)) return "";  // a profile: it never turns back
  const auto low = [&](std::size_t i) { return i == 0 ? -endless : 0.0; };
  const auto high = [&](std::size_t i) {
    return i + 1 == count ? endless : (points[i + 1] - points[i]).norm();
  };
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = i + 2; j < count; ++j)
      if (meet(points[i], t[i], low(i), high(i), points[j], t[j], low(j), high(j)))
        return fmt::format(
            "the straight part from point {} to point {} meets that from point {} to point {} (the "
            "first and the last extend to infinity), allowed: a chain that does not cross or touch "
            "itself",
            i, i + 1, j, j + 1);
  return "";
}

std::string rounding_fault(const std::vector<Vec2>& points, const std::vector<Vec2>& t,
                           double rounding) {
  for (std::size_t i = 0; i < t.size(); ++i) {
    const double begin = i == 0 ? 0 : corner_between(t[i - 1], t[i], rounding).tangent;
    const double end = i + 1 == t.size() ? 0 : corner_between(t[i], t[i + 1], rounding).tangent;
    const double length = (points[i + 1] - points[i]).norm();
    if (begin + end <= length * (1 + chain_round_off)) continue;
    return fmt::format(
        "the arcs at the ends use {:.6g} m of the straight part from point {} to point {}, which "
        "is "
        "{:.6g} m long, allowed: <= {:.6g} m",
        begin + end, i, i + 1, length, rounding * length / (begin + end));
  }
  return "";
}

}  // namespace

std::string fault_of_polyline(const std::vector<Vec2>& points, double rounding) {
  const double size = chain_size(points);
  for (std::size_t i = 0; i + 1 < points.size(); ++i)
    if ((points[i + 1] - points[i]).norm() <= chain_round_off * size)
      return fmt::format("points {} and {} are the same, allowed: points that differ from the next",
                         i, i + 1);
  const std::vector<Vec2> t = directions(points);
  for (std::size_t i = 0; i + 1 < t.size(); ++i)
    if (std::abs(cross(t[i], t[i + 1])) < straight_on && t[i].dot(t[i + 1]) < 0)
      return fmt::format(
          "the chain turns back on itself at point {}, allowed: a turn of less than "
          "180 degrees",
          i + 1);
  const std::string crossing = crossing_fault(points, t);
  return crossing.empty() ? rounding_fault(points, t, rounding) : crossing;
}

ToolSurface make_surface(const std::vector<Vec2>& points, double rounding) {
  const std::vector<Vec2> t = directions(points);
  const double margin = chain_round_off * chain_size(points);
  ToolSurface surface;
  Corner before;
  for (std::size_t i = 0; i < t.size(); ++i) {
    const bool is_last = i + 1 == t.size();
    const Vec2 from = points[i] - points.front();
    const Vec2 next = is_last ? t[i] : t[i + 1];
    const Corner corner = corner_between(t[i], next, rounding);
    const double length = (points[i + 1] - points[i]).norm();
    Piece piece{from.x(), from.y(), t[i].x(), t[i].y()};
    piece.low = i == 0 ? -endless : before.tangent - margin;
    piece.high = is_last ? endless : length - corner.tangent + margin;
    piece.radius = corner.side > 0 ? rounding : 0;
    const Vec2 centre =
        points[i + 1] - points.front() - corner.tangent * t[i] - piece.radius * left_of(t[i]);
    piece.corner_x = centre.x();
    piece.corner_y = centre.y();
    piece.next_tx = next.x();
    piece.next_ty = next.y();
    piece.side = corner.side;
    surface.pieces.push_back(piece);
    before = corner;
  }
  index_pieces(surface);
  return surface;
}

std::vector<Vec2> drawn_points(const ToolSurface& surface) {
  constexpr int chords = 8;  // of an arc
  std::vector<Vec2> drawn{Vec2::Zero()};
  for (const Piece& p : surface.pieces) {
    const Vec2 centre(p.corner_x, p.corner_y), t(p.tx, p.ty), next(p.next_tx, p.next_ty);
    if (p.radius == 0) {
      drawn.push_back(centre);
      continue;
    }
    const double turn = portable::atan2(cross(t, next), t.dot(next));
    for (int k = 0; k <= chords; ++k)
      drawn.push_back(centre + rotation(turn * k / chords) * (p.radius * left_of(t)));
  }
  return drawn;
}

}  // namespace pulvis
