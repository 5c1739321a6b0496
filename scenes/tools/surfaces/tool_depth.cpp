#include "scenes/tools/surfaces/tool_depth.hpp"

#include <cmath>
#include <limits>

#include "systems/space/contact/tool_search.hpp"
#include "systems/space/tools/triangle_kernel.hpp"
#include "systems/tools/surface_kernel.hpp"

namespace pulvis::space {
namespace {

constexpr double far = std::numeric_limits<double>::max();

}  // namespace

// Triangles are kept in a tree of boxes. The nearest one to the centre, at a distance d, is searched for at increasing
// distances; the nearest one to any other point of the sphere is within d + 2 reach of the centre.
void ToolDepth::look_about(const Vec3& centre, double reach) {
  if (shape_.kind != ToolShapes::Kind::mesh || shape_.mesh.triangles.empty()) return;
  const Vec3 from = centre - tool_.point;
  Box box{};
  for (std::size_t k = 0; k < 3; ++k) {
    const double at = from[static_cast<Eigen::Index>(k)];
    box.low[k] = at - reach, box.high[k] = at + reach;
  }
  const auto look = [&](double margin) {
    triangles_.clear();
    triangles_near(shape_.mesh, box, margin, triangles_);
  };
  double margin = reach;
  for (look(margin); triangles_.empty(); look(margin)) margin *= 2;
  look(std::abs(in_mesh(from).depth) + reach);
}

ToolDepth::Place ToolDepth::at(const Vec3& point) const {
  const Vec3 from = point - tool_.point;
  return shape_.kind == ToolShapes::Kind::mesh ? in_mesh(from) : in_revolution(from);
}

ToolDepth::Place ToolDepth::in_revolution(const Vec3& from) const {
  const Vec3& axis = tool_.normal;
  const double height = from.dot(axis);
  const Vec3 arm = from - height * axis;
  const double radius = arm.norm();
  const Vec3 outward = radius > 0 ? Vec3(arm / radius) : Vec3(axis.unitOrthogonal());
  const ToolSurface& meridian = shape_.meridian;
  const auto nearest = pulvis::kernels::nearest_on_surface(
      meridian, 0, static_cast<int>(meridian.pieces.size()) - 1, radius, height, far);
  return {-nearest.distance, nearest.nx * outward + nearest.ny * axis};
}

ToolDepth::Place ToolDepth::in_mesh(const Vec3& from) const {
  const kernels::Vector<double> p{from.x(), from.y(), from.z()};
  kernels::NearestOfMesh<double> nearest{far, {}, {}};
  for (const std::int32_t t : triangles_)
    kernels::look_at_triangle(entry(shape_.mesh.triangles, t), p, nearest);
  const Vec3 outward(nearest.outward.x, nearest.outward.y, nearest.outward.z);
  const double side = dot(nearest.offset, nearest.outward) < 0 ? -1 : 1;
  const double distance = std::sqrt(nearest.square);
  if (!(distance > 0)) return {0, outward};
  return {-side * distance,
          side / distance * Vec3(nearest.offset.x, nearest.offset.y, nearest.offset.z)};
}

}  // namespace pulvis::space
