#include "scenes/tools/surfaces/triangle_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "engine/portable_math.hpp"
#include "scenes/tools/surfaces/flat_triangles.hpp"

namespace pulvis::space {
namespace {

using Triangle = TriangleMesh::Triangle;

constexpr std::int32_t most_of_a_leaf = 4;

Vec3 vector_of(const Point& p) { return {p[0], p[1], p[2]}; }
Point point_of(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

// Sums of outward normals where triangles meet.
struct SharedNormals {
  std::map<Point, Vec3> corner;
  std::map<std::pair<Point, Point>, Vec3> edge;

  static std::pair<Point, Point> ends(const Triangle& t, std::size_t k) {
    return std::minmax(t.corner[k], t.corner[(k + 1) % 3]);
  }
  void add(const Triangle& t) {
    const Vec3 normal = vector_of(t.normal);
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 at = vector_of(t.corner[k]);
      const Vec3 a = (vector_of(t.corner[(k + 1) % 3]) - at).normalized();
      const Vec3 b = (vector_of(t.corner[(k + 2) % 3]) - at).normalized();
      const double angle = portable::atan2(a.cross(b).norm(), a.dot(b));
      corner.try_emplace(t.corner[k], Vec3::Zero()).first->second += angle * normal;
      edge.try_emplace(ends(t, k), Vec3::Zero()).first->second += normal;
    }
  }
  void give(Triangle& t) const {
    for (std::size_t k = 0; k < 3; ++k) {
      t.corner_normal[k] = point_of(corner.at(t.corner[k]).normalized());
      t.edge_normal[k] = point_of(edge.at(ends(t, k)).normalized());
    }
  }
};

struct Extent {
  Point low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
  void add(const Point& p) {
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], p[k]);
      high[k] = std::max(high[k], p[k]);
    }
  }
  std::size_t longest() const {
    std::size_t longest = 0;
    for (std::size_t k = 1; k < 3; ++k)
      if (high[k] - low[k] > high[longest] - low[longest]) longest = k;
    return longest;
  }
};

double middle_along(const Triangle& t, std::size_t axis) {
  return t.corner[0][axis] + t.corner[1][axis] + t.corner[2][axis];
}

// The box of triangles [first, last) and of their halves, which are sorted along its longest side.
void add_node(TriangleMesh& mesh, std::int32_t first, std::int32_t last) {
  Extent extent;
  for (std::int32_t t = first; t < last; ++t)
    for (const Point& p : entry(mesh.triangles, t).corner) extent.add(p);
  const std::size_t number = mesh.tree.size();
  mesh.tree.push_back({extent.low, extent.high, first, last - first});
  if (last - first <= most_of_a_leaf) return;
  const std::int32_t middle = first + (last - first) / 2;
  const auto begin = mesh.triangles.begin();
  std::stable_sort(begin + first, begin + last,
                   [axis = extent.longest()](const auto& a, const auto& b) {
                     return middle_along(a, axis) < middle_along(b, axis);
                   });
  add_node(mesh, first, middle);
  mesh.tree[number].first = static_cast<std::int32_t>(mesh.tree.size());
  mesh.tree[number].count = 0;
  add_node(mesh, middle, last);
}

}  // namespace

TriangleMesh triangle_mesh(const std::vector<std::array<Vec3, 3>>& triangles) {
  TriangleMesh mesh;
  SharedNormals shared;
  for (const std::array<Vec3, 3>& corners : without_flat_triangles(triangles)) {
    const Vec3 normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    if (!(normal.norm() > 0)) continue;
    Triangle t{};
    for (std::size_t k = 0; k < 3; ++k) t.corner[k] = point_of(corners[k]);
    t.normal = point_of(normal.normalized());
    shared.add(t);
    mesh.triangles.push_back(t);
  }
  for (Triangle& t : mesh.triangles) shared.give(t);
  if (!mesh.triangles.empty()) add_node(mesh, 0, static_cast<std::int32_t>(mesh.triangles.size()));
  return mesh;
}

}  // namespace pulvis::space
