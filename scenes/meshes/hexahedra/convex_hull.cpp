#include "scenes/meshes/hexahedra/convex_hull.hpp"

#include <Eigen/LU>
#include <algorithm>

namespace pulvis::space {
namespace {

constexpr double in_plane = 1e-9;   // relative to the size
constexpr double parallel = 1e-7;   // determinant of three unit normals
constexpr double same_face = 1e-9;  // sine between two normals

double size_of(const std::vector<Vec3>& points) {
  double size = 0;
  for (const Vec3& p : points) size = std::max(size, (p - points[0]).norm());
  return size;
}

void add_face(const HalfSpace& face, double near, std::vector<HalfSpace>& faces) {
  const auto same = [&](const HalfSpace& other) {
    return (face.normal - other.normal).norm() < same_face &&
           std::abs(face.offset - other.offset) < near;
  };
  if (std::ranges::none_of(faces, same)) faces.push_back(face);
}

bool all_behind(const std::vector<Vec3>& points, const HalfSpace& face, double near) {
  return std::ranges::all_of(
      points, [&](const Vec3& p) { return face.normal.dot(p) <= face.offset + near; });
}

}  // namespace

std::vector<HalfSpace> faces_of_hull(const std::vector<Vec3>& points) {
  const double size = size_of(points), near = in_plane * size;
  std::vector<HalfSpace> faces;
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t j = i + 1; j < points.size(); ++j)
      for (std::size_t k = j + 1; k < points.size(); ++k) {
        const Vec3 across = (points[j] - points[i]).cross(points[k] - points[i]);
        if (across.norm() < near * size) continue;
        for (const double side : {1.0, -1.0}) {
          const Vec3 normal = side / across.norm() * across;
          const HalfSpace face{normal, normal.dot(points[i])};
          if (all_behind(points, face, near)) add_face(face, near, faces);
        }
      }
  return faces;
}

std::vector<Vec3> corners_between(const std::vector<HalfSpace>& faces) {
  double size = 0;
  for (const HalfSpace& face : faces) size = std::max(size, std::abs(face.offset));
  std::vector<Vec3> corners;
  Eigen::Matrix3d normals;
  for (std::size_t i = 0; i < faces.size(); ++i)
    for (std::size_t j = i + 1; j < faces.size(); ++j)
      for (std::size_t k = j + 1; k < faces.size(); ++k) {
        normals << faces[i].normal.transpose(), faces[j].normal.transpose(),
            faces[k].normal.transpose();
        if (std::abs(normals.determinant()) < parallel) continue;
        const Vec3 p = normals.inverse() * Vec3(faces[i].offset, faces[j].offset, faces[k].offset);
        const bool inside = std::ranges::all_of(faces, [&](const HalfSpace& face) {
          return face.normal.dot(p) <= face.offset + in_plane * size;
        });
        const auto there = [&](const Vec3& q) { return (p - q).norm() < in_plane * size; };
        if (inside && std::ranges::none_of(corners, there)) corners.push_back(p);
      }
  return corners;
}

}  // namespace pulvis::space
