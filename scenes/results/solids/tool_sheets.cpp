#include "scenes/results/solids/tool_sheets.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "engine/enum_table.hpp"
#include "engine/portable_math.hpp"
#include "scenes/tools/constraints.hpp"

namespace pulvis::space {
namespace {

using Box = Eigen::AlignedBox3d;

constexpr int sectors = 48;
constexpr double parallel = 1e-9;       // of unit vectors
constexpr double share_of_punch = 0.2;  // drawn height of a punch over its diameter
constexpr double share_of_face =
    0.2;  // drawn width of the face around a mouth over the diameter of the hole
constexpr int steps_of_edge = 6;  // of the quarter circle of a rounded edge

std::array<Vec3, 8> corners_of(const Box& box) {
  std::array<Vec3, 8> corners;
  for (std::size_t k = 0; k < 8; ++k) corners[k] = box.corner(static_cast<Box::CornerType>(k));
  return corners;
}

struct Reach {
  double low = 0, high = 0;
};

// Extent of the box along a direction, from `from`.
Reach reach_of(const Box& box, const Vec3& direction, const Vec3& from) {
  Reach reach{direction.dot(box.center() - from), direction.dot(box.center() - from)};
  for (const Vec3& corner : corners_of(box)) {
    reach.low = std::min(reach.low, direction.dot(corner - from));
    reach.high = std::max(reach.high, direction.dot(corner - from));
  }
  return reach;
}

// Two unit vectors normal to `axis`, along the scene's axes if possible; first x second is `axis`.
std::array<Vec3, 2> across(const Vec3& axis) {
  int least = 0;
  axis.cwiseAbs().minCoeff(&least);
  const Vec3 first = (Vec3::Unit(least) - axis[least] * axis).normalized();
  return {first, axis.cross(first)};
}

std::vector<Vec3> ring(const Vec3& centre, const Vec3& axis, double radius) {
  const auto [first, second] = across(axis);
  std::vector<Vec3> points;
  for (int i = 0; i < sectors; ++i) {
    const double angle = 2 * std::numbers::pi * i / sectors;
    points.emplace_back(centre +
                        radius * (portable::cos(angle) * first + portable::sin(angle) * second));
  }
  return points;
}

const ToolSpec* die_across(const Scene& scene, const ToolSpec& plane) {
  const auto found = std::ranges::find_if(scene.tools, [&](const ToolSpec& tool) {
    return tool.shape == ToolSpec::Shape::die &&
           std::abs(std::abs(tool.normal.dot(plane.normal)) - 1) < parallel;
  });
  return found == scene.tools.end() ? nullptr : &*found;
}

}  // namespace

FieldInfo ToolSheets::field() {
  return {"tools/outline",
          "m",
          "outlines of the tools $x$",
          "corners of the tools' surfaces, connected by /tools/quads",
          FieldPlace::list,
          3};
}

ToolSheets::ToolSheets(const Scene& scene, const Box& powder) : box_(powder) {
  const Vec3 middle = powder.center();
  for (const ToolSpec& tool : scene.tools) {  // distant tools do not extend the others
    if (tool.shape != ToolSpec::Shape::plane) continue;
    const Vec3 foot = middle + tool.normal.dot(tool.point - middle) * tool.normal;
    if ((foot - middle).norm() < powder.diagonal().norm()) box_.extend(foot);
  }
  for (std::size_t t = 0; t < scene.tools.size(); ++t) {
    if (is_constraint(scene.tools[t])) continue;
    numbers_.push_back(t);
    add_tool(scene, scene.tools[t]);
  }
}

void ToolSheets::add_tool(const Scene& scene, const ToolSpec& tool) {
  faces_.names.push_back(tool.name);
  faces_.kinds.emplace_back(tool_shape_names[tool.shape]);
  switch (tool.shape) {
    case ToolSpec::Shape::plane:
      if (const ToolSpec* die = die_across(scene, tool)) {
        const Vec3 apart = die->point - tool.point;
        const Vec3 centre = apart - tool.normal.dot(apart) * tool.normal;
        add_between(
            std::array{Ring(sectors, centre), ring(centre, tool.normal, die->diameter / 2)});
      } else {
        add_sheet(tool);
      }
      break;
    case ToolSpec::Shape::die:
      add_die(tool);
      break;
    case ToolSpec::Shape::punch:
      add_punch(tool);
      break;
    default:  // a closed surface from a file
      add_triangles(tool);
      break;
  }
}

void ToolSheets::add_piece(std::span<const Vec3> corners) {
  const int tool = static_cast<int>(faces_.names.size()) - 1;
  const auto first = static_cast<std::int32_t>(corners_.size());
  for (const Vec3& corner : corners) {
    corners_.push_back(corner);
    tool_.push_back(tool);
  }
  const auto last = static_cast<std::int32_t>(corners.size()) - 1;
  for (std::int32_t k = 0; k < 4; ++k) faces_.corners.push_back(first + std::min(k, last));
  faces_.tool.push_back(tool);
  faces_.points = corners_.size();
}

// Rings run counter-clockwise as seen from the powder. Quads share the points of the rings between them, so that pictures
// draw no edge there.
void ToolSheets::add_between(std::span<const Ring> rings) {
  const int tool = static_cast<int>(faces_.names.size()) - 1;
  const auto count = static_cast<std::int32_t>(rings.front().size());
  const bool has_tip = rings.front()[0] == rings.front()[1];
  std::int32_t first = -1;  // point of the last ring
  for (const Ring& ring : rings) {
    const bool is_tip = first < 0 && has_tip;
    const auto begin = static_cast<std::int32_t>(corners_.size());
    corners_.insert(corners_.end(), ring.begin(), is_tip ? ring.begin() + 1 : ring.end());
    if (first >= 0) add_quads(first, begin, count, begin - first == 1);
    first = begin;
  }
  tool_.resize(corners_.size(), tool);
  faces_.points = corners_.size();
}

// Between two rings of points; the first one may be a single point.
void ToolSheets::add_quads(std::int32_t inner, std::int32_t outer, std::int32_t count,
                           bool is_tip) {
  for (std::int32_t i = 0; i < count; ++i) {
    const std::int32_t next = (i + 1) % count;
    if (is_tip)
      faces_.corners.insert(faces_.corners.end(), {inner, outer + i, outer + next, outer + next});
    else
      faces_.corners.insert(faces_.corners.end(),
                            {inner + i, outer + i, outer + next, inner + next});
    faces_.tool.push_back(static_cast<int>(faces_.names.size()) - 1);
  }
}

void ToolSheets::add_sheet(const ToolSpec& plane) {
  const auto [first, second] = across(plane.normal);
  const Reach x = reach_of(box_, first, plane.point), y = reach_of(box_, second, plane.point);
  const std::array<Vec3, 4> corners{x.low * first + y.low * second, x.high * first + y.low * second,
                                    x.high * first + y.high * second,
                                    x.low * first + y.high * second};
  add_piece(corners);
}

void ToolSheets::add_die(const ToolSpec& die) {
  const Reach along = reach_of(box_, die.normal, die.point);
  const double radius = die.diameter / 2;
  std::vector<Vec2> wall;  // distance from the axis and height
  if (die.height) {
    const double r = die.rounding, foot = *die.height - r;
    wall.emplace_back(radius, std::min(along.low, foot - share_of_face * die.diameter));
    const int steps = r > 0 ? steps_of_edge : 0;
    for (int i = 0; i <= steps; ++i) {
      const double angle = steps > 0 ? std::numbers::pi / 2 * i / steps : 0;
      wall.emplace_back(radius + r * (1 - portable::cos(angle)), foot + r * portable::sin(angle));
    }
    wall.emplace_back(radius + r + share_of_face * die.diameter, *die.height);
  } else {
    wall = {{radius, along.low}, {radius, along.high}};
  }
  std::vector<Ring> rings;
  for (const Vec2& at : wall) rings.push_back(ring(at.y() * die.normal, die.normal, at.x()));
  add_between(rings);
}

void ToolSheets::add_punch(const ToolSpec& punch) {
  std::vector<Vec2> profile{Vec2(0, punch.profile.empty() ? 0 : punch.profile.front().y())};
  for (const Vec2& point : punch.profile)
    if (point.x() > 0) profile.push_back(point);
  const double radius = std::max(punch.diameter / 2, profile.back().x());
  if (profile.back().x() < radius) profile.emplace_back(radius, profile.back().y());
  profile.emplace_back(radius, profile.back().y() - share_of_punch * 2 * radius);
  const auto at = [&](const Vec2& point) {
    const Vec3 centre = point.y() * punch.normal;
    return point.x() > 0 ? ring(centre, punch.normal, point.x()) : Ring(sectors, centre);
  };
  for (std::size_t i = 0; i + 1 < profile.size(); ++i)
    add_between(std::array{at(profile[i]), at(profile[i + 1])});
}

void ToolSheets::add_triangles(const ToolSpec& tool) {
  for (const auto& triangle : tool.triangles) add_piece(triangle);
}

std::vector<double> ToolSheets::points(std::span<const double> places) const {
  std::vector<double> xyz;
  xyz.reserve(3 * corners_.size());
  for (std::size_t i = 0; i < corners_.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k)
      xyz.push_back(places[3 * number_of(tool_[i]) + k] +
                    corners_[i][static_cast<Eigen::Index>(k)]);
  return xyz;
}

}  // namespace pulvis::space
