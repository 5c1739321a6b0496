// Shapes of all kinds, and measures of their meshes and smooth surfaces, for the tests of this room.
#pragma once

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "scenes/meshes/hexahedra/bezier_patch.hpp"
#include "scenes/meshes/hexahedra/mesh.hpp"

namespace pulvis::space {

inline PolyhedronShape box_shape(const Vec3& size, double rounding,
                                 const Vec3& middle = Vec3::Zero()) {
  PolyhedronShape box;
  for (int i = 0; i < 8; ++i)
    box.corners.push_back(
        middle + 0.5 * size.cwiseProduct(Vec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1)));
  box.rounding = rounding;
  return box;
}

struct ShapeCase {
  std::string name;
  ParticleShape shape;
};
inline std::vector<ShapeCase> shape_cases() {
  return {{"sphere", SphereShape{1e-2}},
          {"needle", EllipsoidShape{Vec3(5, 1, 1)}},
          {"lens", EllipsoidShape{Vec3(3, 3, 1)}},
          {"blunt ellipsoid", EllipsoidShape{Vec3(3, 2, 1)}},
          {"rounded cube", SuperquadricShape{Vec3(1, 1, 1), 4, 4}},
          {"cube, almost", SuperquadricShape{Vec3(1, 1, 1), 8, 8}},
          {"square rod", SuperquadricShape{Vec3(1, 1, 4), 8, 4}},
          {"barrel", SuperquadricShape{Vec3(1, 1, 1), 2, 8}},
          {"pellet", CylinderShape{1, 1, 0.1}},
          {"tablet", CylinderShape{12e-3, 4e-3, 0.5e-3}},
          {"rod", CylinderShape{1, 5, 0.1}},
          {"disc", CylinderShape{5, 1, 0.2}},
          {"box", box_shape({1, 1, 1}, 0.1, {3, -1, 2})},
          {"brick", box_shape({3, 2, 1}, 0.1)},
          {"tetrahedron", PolyhedronShape{{{1, 1, 1}, {-1, -1, 1}, {-1, 1, -1}, {1, -1, -1}}, 0.1}},
          {"octahedron",
           PolyhedronShape{{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
                           0.1}}};
}

inline Shape shape_of(const ParticleShape& shape, int divisions, int rings,
                      std::optional<int> axial_divisions = {}) {
  ParticleSpec particle;
  particle.shape = shape;
  particle.hex_mesh = {divisions, rings, axial_divisions};
  return make_shape(particle);
}

inline Shape extruded(const CylinderShape& shape, int divisions, int rings, int axial_divisions) {
  ParticleSpec particle;
  particle.shape = shape;
  particle.hex_mesh = {divisions, rings, axial_divisions, HexMeshSpec::Grid::extruded};
  return make_shape(particle);
}

// Rods, pellets and tablets in layers, sharp rims and rounded ones.
inline std::vector<std::pair<std::string, Shape>> extruded_cases() {
  return {{"rod", extruded({6.4e-3, 32.4e-3, 0.1e-3}, 4, 3, 30)},
          {"pellet", extruded({1, 1, 0}, 5, 1, 7)},
          {"tablet", extruded({12e-3, 4e-3, 0.4e-3}, 6, 2, 3)},
          {"coarse", extruded({1, 1, 0.1}, 2, 1, 2)}};
}

inline Vec3 node_of(const Shape& shape, int node) {
  const Point& p = entry(shape.nodes, node);
  return {p[0], p[1], p[2]};
}

// The trilinear map's determinant.
inline double jacobian(const Shape& shape, int element, const Vec3& xi) {
  Eigen::Matrix3d j = Eigen::Matrix3d::Zero();
  for (int c = 0; c < 8; ++c) {
    Vec3 sign, factor, slope;
    for (int k = 0; k < 3; ++k) {
      sign[k] = Shape::mode_sign(k, c);
      factor[k] = (1 + sign[k] * xi[k]) / 2;
    }
    for (int k = 0; k < 3; ++k) slope[k] = sign[k] / 2 * factor[(k + 1) % 3] * factor[(k + 2) % 3];
    j += node_of(shape, entry(entry(shape.hexahedra, element), c).value) * slope.transpose();
  }
  return j.determinant();
}

// Two Gauss points along each axis integrate a trilinear element's determinant exactly.
inline double mesh_volume(const Shape& shape) {
  double volume = 0;
  for (int e = 0; e < shape.elements(); ++e)
    for (int g = 0; g < 8; ++g)
      volume +=
          jacobian(shape, e, Vec3(g & 1 ? 1 : -1, g & 2 ? 1 : -1, g & 4 ? 1 : -1) / std::sqrt(3.0));
  return volume;
}

// (u, v) at `along` from 0 to 1 of a side.
inline std::array<double, 2> on_side(int side, double along) {
  constexpr double corner[5][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}};
  return {corner[side][0] + along * (corner[side + 1][0] - corner[side][0]),
          corner[side][1] + along * (corner[side + 1][1] - corner[side][1])};
}

inline double smooth_volume(const Shape& shape, const std::vector<Vec3>& points) {
  double volume = 0;
  for (const Shape::Face& face : shape.faces) volume += volume_under(face.point, points);
  return volume;
}

}  // namespace pulvis::space
