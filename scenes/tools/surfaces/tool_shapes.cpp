#include "scenes/tools/surfaces/tool_shapes.hpp"

#include <algorithm>

#include "scenes/tools/surface.hpp"
#include "scenes/tools/surfaces/triangle_mesh.hpp"
#include "systems/contact/surface_search.hpp"

namespace pulvis::space {
namespace {

using Kind = ToolShapes::Kind;

// No powder gets past its rim.
bool fills_a_die(const ToolSpec& punch, const Scene& scene) {
  constexpr double round_off = 1e-9;
  return punch.diameter == 0 || std::ranges::any_of(scene.tools, [&](const ToolSpec& tool) {
           return tool.shape == ToolSpec::Shape::die &&
                  tool.diameter <= punch.diameter * (1 + round_off);
         });
}

Kind kind_of(const ToolSpec& tool) {
  switch (tool.shape) {
    case ToolSpec::Shape::plane:
      return Kind::plane;
    case ToolSpec::Shape::die:
      return tool.height ? Kind::revolution : Kind::hole;
    case ToolSpec::Shape::punch:
      return Kind::revolution;
    case ToolSpec::Shape::constraint:
      return Kind::constraint;
    default:  // a closed surface from a file
      return Kind::mesh;
  }
}

// make_surface uses coordinates relative to the first point.
void move_by(const Vec2& shift, ToolSurface& surface) {
  for (ToolSurface::Piece& piece : surface.pieces) {
    piece.x += shift.x();
    piece.y += shift.y();
    piece.corner_x += shift.x();
    piece.corner_y += shift.y();
  }
  index_pieces(surface);
}

// Up the wall, which has no lower end, and outwards along the face at the mouth.
ToolSurface die_meridian(const ToolSpec& die) {
  const double radius = die.diameter / 2, far = std::max(radius, 1.0);
  const std::vector<Vec2> chain{
      {radius, *die.height - far}, {radius, *die.height}, {radius + far, *die.height}};
  ToolSurface meridian = make_surface(chain, die.rounding);
  move_by(chain.front(), meridian);
  return meridian;
}

}  // namespace

ToolSurface punch_meridian(const ToolSpec& punch, bool open) {
  std::vector<Vec2> half = punch.profile;
  if (half.empty()) half = {Vec2::Zero()};
  const double radius = std::max(punch.diameter / 2, half.back().x());
  if (half.back().x() < radius) half.emplace_back(radius, half.back().y());
  const double far = std::max(radius, 1.0);
  const Vec2 end = half.back();
  half.push_back(open ? Vec2(end.x() + far, end.y()) : Vec2(end.x(), end.y() - far));
  std::vector<Vec2> chain;
  for (auto p = half.rbegin(); p != half.rend(); ++p)
    if (p->x() > 0) chain.emplace_back(-p->x(), p->y());
  chain.insert(chain.end(), half.begin(), half.end());
  ToolSurface meridian = make_surface(chain, 0);
  move_by(chain.front(), meridian);
  return meridian;
}

ToolShapes tool_shapes(const Scene& scene) {
  ToolShapes shapes;
  for (const ToolSpec& tool : scene.tools) {
    ToolShapes::Shape& shape = shapes.of_tool.emplace_back();
    shape.kind = kind_of(tool);
    if (shape.kind == Kind::hole) shape.radius = tool.diameter / 2;
    if (shape.kind == Kind::revolution)
      shape.meridian = tool.shape == ToolSpec::Shape::die
                           ? die_meridian(tool)
                           : punch_meridian(tool, fills_a_die(tool, scene));
    if (shape.kind == Kind::mesh) shape.mesh = triangle_mesh(tool.triangles);
  }
  return shapes;
}

}  // namespace pulvis::space
