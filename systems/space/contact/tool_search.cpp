#include "systems/space/contact/tool_search.hpp"

#include <cmath>

#include "systems/contact/surface_search.hpp"

namespace pulvis::space {
namespace {

Point point_of(const PatchNumbers& face, int p) { return {face(0, p), face(1, p), face(2, p)}; }

Point difference(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double product(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

// Height along the axis through a tool's position, and distance from that axis.
struct AboutAxis {
  double height, radius;
  AboutAxis(const Point& at, const Point& axis) {
    height = product(at, axis);
    radius = std::sqrt(std::max(product(at, at) - height * height, 0.0));
  }
};

// For a convex set, extremes along the axis and bounds of the radius from the centre are at its Bezier points.
bool near_meridian(const ToolSurface& meridian, const PatchNumbers& face, const Point& at,
                   const Point& axis, double reach) {
  const Point middle = difference(face_box(face).middle(), at);
  const AboutAxis centre(middle, axis);
  pulvis::Box box{{0, centre.height}, {0, centre.height}};
  double extent = 0;
  for (int p = 0; p < 16; ++p) {
    const Point arm = difference(difference(point_of(face, p), at), middle);
    const AboutAxis from_middle(arm, axis);
    extent = std::max(extent, from_middle.radius);
    box.low[1] = std::min(box.low[1], centre.height + from_middle.height);
    box.high[1] = std::max(box.high[1], centre.height + from_middle.height);
  }
  box.low[0] = std::max(centre.radius - extent, 0.0);
  box.high[0] = centre.radius + extent;
  return !pieces_near(meridian, box, reach).empty();
}

Box around_origin(const PatchNumbers& face, const Point& at) {
  return moved(face_box(face), {-at[0], -at[1], -at[2]});
}

}  // namespace

bool FaceLook::can_touch(int slot, int face, int tool) const {
  const PatchNumbers points = bodies.patch(positions, slot, face);
  const ToolShapes::Shape& shape = tools.shape(tool);
  const Point at = tools.position_of(tool), normal = tools.normal_of(tool);
  const double reach = distance + entry(bodies.shape_of(slot).faces, face).size;
  switch (shape.kind) {
    case ToolShapes::Kind::plane:
      for (int p = 0; p < 16; ++p)
        if (product(difference(point_of(points, p), at), normal) < distance) return true;
      return false;
    case ToolShapes::Kind::hole:
      for (int p = 0; p < 16; ++p)
        if (AboutAxis(difference(point_of(points, p), at), normal).radius > shape.radius - distance)
          return true;
      return false;
    case ToolShapes::Kind::revolution:
      return near_meridian(shape.meridian, points, at, normal, reach);
    case ToolShapes::Kind::constraint:
      return false;
    case ToolShapes::Kind::mesh:
      break;
  }
  std::vector<std::int32_t> list;
  triangles_near(shape.mesh, around_origin(points, at), reach, list);
  return !list.empty();
}

void FaceLook::add_triangles(const ToolCandidate& c, std::vector<std::int32_t>& list) const {
  const PatchNumbers points = bodies.patch(positions, c.slot, c.face);
  const double reach = distance + entry(bodies.shape_of(c.slot).faces, c.face).size;
  triangles_near(tools.shape(c.tool).mesh, around_origin(points, tools.position_of(c.tool)), reach,
                 list);
}

BySlot<ToolCandidate> tool_candidates(const FaceLook& look) {
  return list_by_slot<ToolCandidate>(
      look.bodies.slots(), [&](int slot, std::vector<ToolCandidate>& found) {
        if (!look.bodies.bodies->owns(slot)) return;
        const auto faces = static_cast<std::int32_t>(look.bodies.shape_of(slot).faces.size());
        for (std::int32_t f = 0; f < faces; ++f)
          for (std::int32_t t = 0; t < look.tools.position.rows(); ++t)
            if (look.can_touch(slot, f, t)) found.push_back({slot, f, t});
      });
}

void triangles_near(const TriangleMesh& mesh, const Box& box, double reach,
                    std::vector<std::int32_t>& list) {
  std::array<std::int32_t, 64> open;  // nodes of the tree; sized for its maximum depth
  std::size_t count = 0;
  if (!mesh.tree.empty()) open[count++] = 0;
  while (count > 0) {
    const std::int32_t number = open[--count];
    const TriangleMesh::Node& node = entry(mesh.tree, number);
    if (!near(Box{node.low, node.high}, box, reach)) continue;
    for (std::int32_t t = node.first; t < node.first + node.count; ++t) list.push_back(t);
    if (node.count > 0) continue;
    open[count++] = node.first;
    open[count++] = number + 1;
  }
}

}  // namespace pulvis::space
