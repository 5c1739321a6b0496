// Shapes of particles in three dimensions and their meshes of hexahedra: plain values, SI units.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "scenes/language/vectors.hpp"

namespace pulvis {

// ---- shapes, each in its local frame; size: extent along x, y, z, m -------------------------------
struct SphereShape {
  double diameter = 0;  // m
  bool operator==(const SphereShape&) const = default;
};
struct EllipsoidShape {
  Vec3 size = Vec3::Zero();
  bool operator==(const EllipsoidShape&) const = default;
};
// |2x/a|^e + |2y/b|^e)^(f/e) + |2z/c|^f = 1 (Barr 1981), e: exponent_xy, f: exponent_z; 2 and 2: an ellipsoid.
struct SuperquadricShape {
  Vec3 size = Vec3::Zero();
  double exponent_xy = 2;  // -, >= 2
  double exponent_z = 2;   // -, >= 2
  bool operator==(const SuperquadricShape&) const = default;
};
struct CylinderShape {  // along z: tablets, pellets
  double diameter = 0;  // m
  double height = 0;    // m
  double rounding = 0;  // m, radius of the rims
  bool operator==(const CylinderShape&) const = default;
};
struct
    PolyhedronShape {  // convex hull of its corners, edges and corners rounded: hull of the inset polyhedron plus a sphere
  std::vector<Vec3> corners = {};  // m
  double rounding = 0;             // m, radius of edges and corners
  bool operator==(const PolyhedronShape&) const = default;
};
struct StlShape {         // closed surface that is star-shaped about its centre of volume
  std::string file = {};  // relative to the scene
  std::string unit = {};  // of its numbers
  std::optional<double> diameter = {};  // m, of the sphere of equal volume, to which it is scaled
  double smoothing = 0;                 // -, smoothing length relative to the mean radius
  std::vector<std::array<Vec3, 3>> triangles = {};  // m, set once it has been read
  bool operator==(const StlShape&) const = default;
};
using ParticleShape = std::variant<SphereShape, EllipsoidShape, SuperquadricShape, CylinderShape,
                                   PolyhedronShape, StlShape>;
inline std::size_t stl_bytes(const ParticleShape& shape) {  // of its triangles; 0 if it has none
  const auto* stl = std::get_if<StlShape>(&shape);
  return stl == nullptr ? 0 : stl->triangles.size() * sizeof(stl->triangles[0]);
}

struct HexMeshSpec {
  int divisions = 4;                        // >= 1, of the cube's edges, or of the square's
  int rings = 4;                            // >= 1
  std::optional<int> axial_divisions = {};  // >= 2, along z; needs divisions >= 2
  enum class Grid {
    cube,  // O-grid on a cubed sphere: a core of divisions^2 * axial() and `rings` layers around it
    extruded,  // for cylinders: the O-grid of a disc in axial() layers; needs divisions >= 2
  } grid = Grid::cube;
  bool operator==(const HexMeshSpec&) const = default;

  int axial() const { return axial_divisions.value_or(divisions); }
  std::int64_t hexahedra() const {
    const std::int64_t n = divisions, m = axial();
    if (grid == Grid::extruded) return (n * n + 4 * n * rings) * m;
    return n * n * m + (2 * n * n + 4 * n * m) * rings;
  }
  std::int64_t faces() const {
    const std::int64_t n = divisions, m = axial();
    if (grid == Grid::extruded) return 2 * (n * n + 4 * n * rings) + 4 * n * m;
    return 2 * n * n + 4 * n * m;
  }
  std::int64_t surface_nodes() const {
    return faces() + 2;
  }  // Euler's formula for four-sided faces
  std::int64_t surface_points()
      const {  // of Bezier patches, approximately: at nodes, on sides and inside
    return surface_nodes() + 8 * faces();
  }
  std::int64_t nodes() const {
    const std::int64_t n = divisions, m = axial(), core = (n + 1) * (n + 1);
    if (grid == Grid::extruded) return (core + 4 * n * rings) * (m + 1);
    return core * (m + 1) + surface_nodes() * rings;
  }
};

}  // namespace pulvis
