#include "scenes/checks/solids/thin_walls.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <tuple>

#include "engine/entry.hpp"
#include "scenes/checks/solids/class_shape.hpp"
#include "scenes/tools/surfaces/triangle_mesh.hpp"
#include "systems/space/contact/tool_search.hpp"

namespace pulvis::space {
namespace {

using Triangle = TriangleMesh::Triangle;

// Penetrations reach a tenth of a face in dense compacts; half of the wall must be more.
constexpr double thin = 0.2;  // of the smallest face

Vec3 vector_of(const Point& p) { return {p[0], p[1], p[2]}; }

// Where the ray leaves through the triangle, as a distance from `from`; nothing if it does not (T. Moeller & B. Trumbore, Journal
// of Graphics Tools 2 (1997) 21).
std::optional<double> exit_through(const Triangle& triangle, const Vec3& from,
                                   const Vec3& direction) {
  if (direction.dot(vector_of(triangle.normal)) <= 0) return {};
  const Vec3 a = vector_of(triangle.corner[0]), u = vector_of(triangle.corner[1]) - a,
             v = vector_of(triangle.corner[2]) - a;
  const Vec3 across = direction.cross(v);
  const double all = u.dot(across);
  if (all == 0) return {};
  const Vec3 offset = from - a, turned = offset.cross(u);
  const double s = offset.dot(across) / all, t = direction.dot(turned) / all;
  const double distance = v.dot(turned) / all;
  if (s < 0 || t < 0 || s + t > 1 || distance < 0) return {};
  return distance;
}

class Walls {
 public:
  Walls(const TriangleMesh& mesh, double below) : mesh_(mesh), wall_{below, {}}, below_(below) {}

  std::optional<ThinWall> thinnest() {
    for (const Triangle& triangle : mesh_.triangles) {
      const Vec3 middle = middle_of(triangle);
      look_from(middle, triangle);
      for (const Point& corner : triangle.corner)
        look_from(0.25 * middle + 0.75 * vector_of(corner), triangle);
    }
    return wall_.thickness < below_ ? std::optional(wall_) : std::nullopt;
  }

 private:
  static Vec3 middle_of(const Triangle& t) {
    return (vector_of(t.corner[0]) + vector_of(t.corner[1]) + vector_of(t.corner[2])) / 3;
  }

  void look_from(const Vec3& from, const Triangle& triangle) {
    const Vec3 inwards = -vector_of(triangle.normal), end = from + wall_.thickness * inwards;
    Box box;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto i = static_cast<Eigen::Index>(k);
      std::tie(box.low[k], box.high[k]) = std::minmax(from[i], end[i]);
    }
    near_.clear();
    triangles_near(mesh_, box, 0, near_);
    for (const std::int32_t t : near_)
      if (const auto distance = exit_through(entry(mesh_.triangles, t), from, inwards);
          distance && *distance < wall_.thickness)
        wall_ = {*distance, from};
  }

  const TriangleMesh& mesh_;
  ThinWall wall_;
  double below_;
  std::vector<std::int32_t> near_;
};

// A mesh is made once for all sizes of a class.
double smallest_face(const Scene& scene) {
  const std::vector<ParticleSpec>& particles = scene.particles;
  std::vector<double> scale(particles.size(), 1);  // of the smallest particle of a class
  for (const ParticleSpec& spec : particles)
    if (spec.class_of >= 0)
      entry(scale, spec.class_of) = std::min(entry(scale, spec.class_of), spec.scale);
  double smallest = std::numeric_limits<double>::max();
  for (std::size_t i = 0; i < particles.size(); ++i)
    if (particles[i].class_of < 0)
      for (const Shape::Face& face : class_shape(scene, i).faces)
        smallest = std::min(smallest, scale[i] * face.size);
  return smallest;
}

}  // namespace

std::optional<ThinWall> thinnest_wall(const std::vector<std::array<Vec3, 3>>& triangles,
                                      double below) {
  return Walls(triangle_mesh(triangles), below).thinnest();
}

std::vector<std::string> thin_wall_warnings(const Scene& scene) {
  std::vector<std::string> lines;
  double below = 0;
  for (const ToolSpec& tool : scene.tools) {
    if (tool.triangles.empty()) continue;
    if (below == 0) below = thin * smallest_face(scene);
    if (const auto wall = thinnest_wall(tool.triangles, below))
      lines.push_back(fmt::format(
          "tool '{}' is only {:.3g} m thick at ({:.4g}, {:.4g}, {:.4g}) m of its file: a particle "
          "that penetrates it by half of that passes through, which the run does not notice; use a "
          "wall of more than {:.3g} m, {:g} of the smallest face",
          tool.name, wall->thickness, wall->at.x(), wall->at.y(), wall->at.z(), below, thin));
  }
  return lines;
}

}  // namespace pulvis::space
