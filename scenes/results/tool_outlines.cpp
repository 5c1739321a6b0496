#include "scenes/results/tool_outlines.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "components/contact.hpp"
#include "scenes/tools/die_sides.hpp"
#include "scenes/tools/surface.hpp"

namespace pulvis {
namespace {

constexpr double share_of_box = 0.06;  // thickness of a body relative to the size of the box

Vec2 place_of(const World& world, std::size_t tool) {
  const double* at = world.column<ToolPosition>().values() + tool_axes * tool;
  return {at[0], at[1]};
}

Vec2 along(const Vec2& normal) { return {normal.y(), -normal.x()}; }

bool is_wall(const Vec2& normal) { return std::abs(normal.x()) > std::abs(normal.y()); }

}  // namespace

FieldInfo ToolOutlines::field() {
  return {"tools/outline",
          "m",
          "outlines of the tools $x$",
          "corners of the tools' outlines, connected by /tools/lines",
          FieldPlace::list,
          2};
}

ToolOutlines::ToolOutlines(const Scene& scene, const World& world, const std::vector<double>& nodes)
    : box_{Vec2::Constant(std::numeric_limits<double>::infinity()),
           Vec2::Constant(-std::numeric_limits<double>::infinity())} {
  for (std::size_t i = 0; i + 1 < nodes.size(); i += 2) take_in({nodes[i], nodes[i + 1]});
  const Vec2 middle = 0.5 * (box_.low + box_.high);
  const double far = (box_.high - box_.low).norm();
  for (std::size_t t = 0; t < scene.tools.size(); ++t) {  // distant ones do not lengthen the others
    if (scene.tools[t].shape != ToolSpec::Shape::plane) continue;
    const Vec2 n = in_plane(scene.tools[t].normal);
    const Vec2 foot = middle + n.dot(place_of(world, t) - middle) * n;
    if ((foot - middle).norm() < far) take_in(foot);
  }
  thickness_ = share_of_box * (box_.high - box_.low).maxCoeff();
  for (std::size_t t = 0; t < scene.tools.size(); ++t) {
    const ToolSpec& tool = scene.tools[t];
    if (tool.shape == ToolSpec::Shape::constraint) continue;
    const bool plane = tool.shape == ToolSpec::Shape::plane;
    if (!plane && tool.points.size() < 2) continue;
    Body body{t, tool.name, face_normal(tool), {}};
    if (!plane) body.face = endless_face(tool, place_of(world, t));
    for (const Vec2& p : body.face)
      if (&p == &body.face.front() || body.normal.dot(p - body.foremost) > 0) body.foremost = p;
    bodies_.push_back(std::move(body));
  }
}

void ToolOutlines::take_in(const Vec2& point) {
  box_.low = box_.low.cwiseMin(point);
  box_.high = box_.high.cwiseMax(point);
}

// A polyline is extended straight beyond its ends: as far as the box extends, or a little.
std::vector<Vec2> ToolOutlines::endless_face(const ToolSpec& tool, const Vec2& at) const {
  const std::vector<Vec2> drawn = drawn_points(make_surface(tool.points, tool.rounding));
  const std::size_t last = drawn.size() - 1;
  const Vec2 margin = Vec2::Constant(thickness_), low = box_.low - margin,
             high = box_.high + margin;
  const Vec2 chord = (drawn[last] - drawn[0]).normalized();
  const auto beyond = [&](const Vec2& end, const Vec2& inner, const Vec2& outwards) {
    const Vec2 d = (end - inner).normalized();
    double missing = 0;
    for (const double x : {low.x(), high.x()})
      for (const double y : {low.y(), high.y()})
        missing = std::max(missing, outwards.dot(Vec2(x, y) - at - end));
    const double slope = outwards.dot(d);
    return Vec2(end + std::max(slope > 0.1 ? missing / slope : 0, thickness_) * d);
  };
  std::vector<Vec2> face{beyond(drawn[0], drawn[1], -chord)};
  for (const Vec2& p : drawn) face.push_back(p);
  face.push_back(beyond(drawn[last], drawn[last - 1], chord));
  return face;
}

ToolLines ToolOutlines::lines() const {
  ToolLines lines;
  std::int32_t first = 0;
  for (const Body& body : bodies_) {
    const std::int32_t count =
        2 + (body.face.empty() ? 2 : static_cast<std::int32_t>(body.face.size()));
    for (std::int32_t i = 0; i < count; ++i) {
      lines.ends.insert(lines.ends.end(), {first + i, first + (i + 1) % count});
      lines.tool.push_back(static_cast<std::int32_t>(lines.names.size()));
    }
    lines.names.push_back(body.name);
    first += count;
  }
  return lines;
}

// Clips the line along `punch` to the powder's side of `wall`: parameters from its position.
void ToolOutlines::clip(const World& world, const Body& wall, const Body& punch, double& from,
                        double& to) const {
  const double slope = wall.normal.dot(along(punch.normal));
  if (std::abs(slope) < 1e-9) return;
  const Vec2 apart = place_of(world, wall.tool) + wall.foremost - place_of(world, punch.tool);
  const double at = wall.normal.dot(apart) / slope;
  slope > 0 ? from = std::max(from, at) : to = std::min(to, at);
}

std::vector<Vec2> ToolOutlines::face_of_plane(const World& world, const Body& plane) const {
  const Vec2 at = place_of(world, plane.tool), tangent = along(plane.normal);
  double from = std::numeric_limits<double>::infinity(), to = -from;
  for (const double x : {box_.low.x(), box_.high.x()})
    for (const double y : {box_.low.y(), box_.high.y()}) {
      from = std::min(from, tangent.dot(Vec2(x, y) - at) - thickness_);
      to = std::max(to, tangent.dot(Vec2(x, y) - at) + thickness_);
    }
  double left = from, right = to;
  if (!is_wall(plane.normal))
    for (const Body& other : bodies_)
      if (is_wall(other.normal)) clip(world, other, plane, left, right);
  if (left < right) from = left, to = right;  // otherwise it lies outside them
  return {at + from * tangent, at + to * tangent};
}

double ToolOutlines::depth_behind(const Body& body, const std::vector<Vec2>& face) const {
  double lowest = std::numeric_limits<double>::infinity();
  for (const Vec2& p : face) lowest = std::min(lowest, body.normal.dot(p));
  return lowest - thickness_;
}

std::vector<double> ToolOutlines::points(const World& world) const {
  std::vector<double> xy;
  const auto append = [&](const Vec2& p) { xy.insert(xy.end(), {p.x(), p.y()}); };
  for (const Body& body : bodies_) {
    std::vector<Vec2> face = body.face;
    for (Vec2& p : face) p += place_of(world, body.tool);
    if (face.empty()) face = face_of_plane(world, body);
    const double behind = depth_behind(body, face);
    for (const Vec2& p : face) append(p);
    for (const std::size_t end : {face.size() - 1, std::size_t{0}}) {
      const Vec2& p = face[end];
      append(p + (behind - body.normal.dot(p)) * body.normal);
    }
  }
  return xy;
}

}  // namespace pulvis
