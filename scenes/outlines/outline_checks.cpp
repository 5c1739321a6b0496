#include "scenes/outlines/outline_checks.hpp"
#include "scenes/outlines/curve_of.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/portable_math.hpp"
#include "scenes/outlines/fourier_outline.hpp"
#include "scenes/outlines/outline_curve.hpp"
#include "scenes/outlines/star.hpp"

namespace pulvis {
namespace {

using Faults = std::vector<OutlineFault>;

// An O-grid in a very elongated outline has equally flat elements; 8 is already beyond any powder.
constexpr double longest_over_shortest = 8;
// Beyond this the two sides of a corner nearly coincide.
constexpr double max_turn = 170.0 / 180 * std::numbers::pi;
// For an irregular outline, over its mean: below 0 it crosses itself, and near 0 there is no room for elements.
constexpr double min_radius = 0.2;

std::string text_of(const Vec2& p) { return fmt::format("({:g}, {:g}) m", p.x(), p.y()); }

Faults slender(double width, double height) {
  const double ratio = std::max(width, height) / std::min(width, height);
  if (ratio <= longest_over_shortest) return {};
  return {{"height", fmt::format("one side is {:g} times the other, allowed: at most {:g} times",
                                 ratio, longest_over_shortest)}};
}

Faults unseen(const OutlineCurve& curve, const std::string& key, const std::string& help) {
  if (star_centre(curve.polygon(1e-3 * std::sqrt(std::abs(curve.area()))))) return {};
  return {{key,
           "there is no point inside from which the whole outline is visible, so it cannot be "
           "meshed, allowed: star-shaped outlines, which have such a point" +
               help}};
}

Faults crossing(const std::vector<Vec2>& points, const std::string& key, const std::string& what) {
  const auto sides = crossing_sides(points);
  if (!sides) return {};
  const auto side = [&](std::size_t i) {
    return fmt::format("{} {} and {}", what, i + 1, (i + 1) % points.size() + 1);
  };
  return {{key, fmt::format("the outline crosses itself: the side between {} meets the one between "
                            "{}, allowed: sides that meet only at their ends",
                            side(sides->first), side(sides->second))}};
}

double turn_at(const Vec2& a, const Vec2& b, const Vec2& c) {
  return portable::atan2(cross(b - a, c - b), (b - a).dot(c - b));
}

// For the corners as given: their indices are the user's.
Faults bad_corners(const PolygonOutline& polygon) {
  const std::vector<Vec2>& given = polygon.corners;
  const std::size_t n = given.size();
  if (n < 3)
    return {{"corners", fmt::format("{} corners enclose nothing, allowed: at least 3", n)}};
  for (std::size_t i = 0; i < n; ++i)
    if (given[i] == given[(i + 1) % n])
      return {{"corners", fmt::format("corners {} and {} are one point, {}, allowed: each once",
                                      i + 1, (i + 1) % n + 1, text_of(given[i]))}};
  for (std::size_t i = 0; i < n; ++i)
    if (std::abs(turn_at(given[(i + n - 1) % n], given[i], given[(i + 1) % n])) > max_turn)
      return {{"corners", fmt::format("at corner {} the outline turns back on itself, allowed: "
                                      "corners of at least 10 degrees",
                                      i + 1)}};
  return crossing(given, "corners", "corners");
}

// The largest rounding whose arcs fit on every side.
double max_rounding(const std::vector<Vec2>& corners) {
  const std::size_t n = corners.size();
  double maximum = std::numeric_limits<double>::max();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 &a = corners[(i + n - 1) % n], &b = corners[i], &c = corners[(i + 1) % n],
               &d = corners[(i + 2) % n];
    const double cut = cut_by_rounding(a, b, c, 1) + cut_by_rounding(b, c, d, 1);
    if (cut > 0) maximum = std::min(maximum, (c - b).norm() / cut);
  }
  return maximum;
}

Faults bad_rounding(const PolygonOutline& polygon) {
  const std::vector<Vec2> corners = corners_of(polygon);
  const std::size_t n = corners.size();
  const double maximum = max_rounding(corners);
  if (polygon.rounding > maximum * (1 + 1e-12))
    return {{"rounding", fmt::format("{:g} m is too large for the sides, allowed: <= {:g} m",
                                     polygon.rounding, maximum)}};
  for (std::size_t i = 0; polygon.rounding == 0 && i < n; ++i)
    if (turn_at(corners[(i + n - 1) % n], corners[i], corners[(i + 1) % n]) < 0)
      return {{"rounding", fmt::format("the corner at {} points inwards and is sharp, allowed: > 0 "
                                       "and <= {:g} m where a corner points inwards",
                                       text_of(corners[i]), maximum)}};
  return {};
}

// The largest amplitude of some modes at which the radius never falls below its minimum, where others use up
// `taken` of it.
template <class Taken>
double max_amplitude(const std::vector<FourierModes::Mode>& modes, const Taken& taken) {
  constexpr int angles = 1024;  // 16 per shortest wave
  double maximum = std::numeric_limits<double>::max();
  for (int i = 0; i < angles; ++i) {
    const double angle = 2 * std::numbers::pi * i / angles;
    const portable::Turn turn{portable::cos(angle), portable::sin(angle)};
    const double value = sum_at(modes, turn).value;
    if (value < 0) maximum = std::min(maximum, (1 - min_radius + taken(turn)) / -value);
  }
  return std::max(0.0, maximum);
}

Faults hollow(const std::string& key, double given, double maximum) {
  return {
      {key, fmt::format("{:g} brings the outline closer to its centre than {:g} of the mean "
                        "radius, where it may cross itself, allowed: <= {:.3g} with these phases",
                        given, min_radius, std::floor(maximum * 1e3) / 1e3)}};
}

}  // namespace

Faults faults_of(const EllipseOutline& outline) { return slender(outline.width, outline.height); }

Faults faults_of(const SuperellipseOutline& outline) {
  return slender(outline.width, outline.height);
}

Faults faults_of(const PolygonOutline& outline) {
  const bool regular = outline.sides > 0;
  if (regular == !outline.corners.empty())
    return {{"corners", regular ? "a regular polygon has corners already, allowed: either sides "
                                  "and diameter, or corners"
                                : "required key is missing, allowed: either sides and diameter, or "
                                  "corners"}};
  if (!regular && outline.diameter > 0)
    return {{"diameter", "has no effect together with corners, allowed: only together with sides"}};
  Faults faults = regular ? Faults{} : bad_corners(outline);
  if (faults.empty()) faults = bad_rounding(outline);
  if (faults.empty()) faults = unseen(curve_of(outline), "corners", "");
  return faults;
}

Faults faults_of(const PointsOutline& outline) {
  const int scales =
      outline.width.has_value() + outline.diameter.has_value() + outline.area.has_value();
  if (scales > 1)
    return {{outline.width ? "width" : "diameter",
             "the outline can be scaled only once, allowed: one of width, diameter and area"}};
  Faults faults = crossing(outline.points, "file", "points");
  if (faults.empty())
    faults = unseen(curve_of(outline), "file", ", or more smoothing if the points are noisy");
  return faults;
}

Faults faults_of(const FourierOutline& outline) {
  const FourierModes modes = fourier_modes(outline);
  const double most_rough = max_amplitude(modes.rough, [](portable::Turn) { return 0.0; });
  if (outline.roughness > most_rough) return hollow("roughness", outline.roughness, most_rough);
  const double most_irregular = max_amplitude(modes.irregular, [&](portable::Turn turn) {
    return outline.roughness * sum_at(modes.rough, turn).value;
  });
  if (outline.irregularity > most_irregular)
    return hollow("irregularity", outline.irregularity, most_irregular);
  return unseen(curve_of(outline), "irregularity", "");
}

}  // namespace pulvis
