// The powder and the tools of a scene in three dimensions (`dimension = 3`): plain values, SI units. Everything shared
// with two dimensions (materials, friction, contact, stages, limits, output) is in scenes/spec/scene.hpp.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "scenes/spec/rotation.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis::space {

using Vec3 = pulvis::Vec3;
using Rotation = Rotation3;

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

struct MeshSpec {
  int divisions = 4;                        // >= 1, of the cube's edges, or of the square's
  int rings = 4;                            // >= 1
  std::optional<int> axial_divisions = {};  // >= 2, along z; needs divisions >= 2
  enum class Grid {
    cube,  // O-grid on a cubed sphere: a core of divisions^2 * axial() and `rings` layers around it
    extruded,  // for cylinders: the O-grid of a disc in axial() layers; needs divisions >= 2
  } grid = Grid::cube;
  bool operator==(const MeshSpec&) const = default;

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

struct ParticleSpec {  // a class of identical particles
  std::string name;
  int material = 0;  // index in Scene::materials
  ParticleShape shape;
  MeshSpec mesh;
  bool random_mesh_phase = false;  // spheres: every particle's mesh is randomly rotated
  SourceMark mark;
  int class_of =
      -1;  // for one size of a packing: the class that is scaled, in SpaceScene::particles
  double scale = 1;  // factor on that class's shape
};

// The container of a packing: a box, or a cylinder along z. Lower corner, or centre of the floor.
struct ContainerSpec {
  enum class Kind { box, cylinder } kind = Kind::box;
  Vec3 corner = Vec3::Zero();   // m
  double width = 0, depth = 0;  // m, along x, y: of a box
  double diameter = 0;          // m, of a cylinder
};

// Lattices fill nx * ny * nz cells of `spacing`, starting at `corner`. Random: a mixture in a container, for which two
// of count, density and height are given. CSV: positions from a file.
struct PackingSpec {
  enum class Kind { cubic, body_centred, face_centred, hexagonal, random, csv } kind = Kind::cubic;
  enum class Dense { given, touching, densest };
  int particle = 0;
  std::array<int, 3> cells{1, 1, 1};  // along x, y, z
  double spacing = 0;            // m, edge of the cubic cell; hexagonal: nearest-neighbour distance
  ContainerSpec container;       // for lattices: only `corner`
  std::optional<double> height;  // m
  std::optional<int> count;      // if the classes give fractions
  std::optional<double> density;  // -
  Dense dense = Dense::given;
  std::string file;                   // relative to the scene's folder
  std::vector<MixtureClass> classes;
  SourceMark mark;
  // For random and CSV packings, set once the scene has been read:
  std::vector<BodySpec> placed = {};
  double top = 0;  // m, where a punch rests on the packing
  PackingReached reached = {};
};

// Rigid tools. A plane fills the half-space behind `point` and faces along `normal`. A die is the inside of a round hole
// along `axis`; a punch is a body of revolution about `axis` through `point`, whose face has a profile: height over
// the radius; an STL tool is a closed surface with outward normals that moves as a whole.
struct ToolSpec {
  enum class Shape { plane, die, punch, stl };
  std::string name;
  Shape shape = Shape::plane;
  Vec3 point = Vec3::Zero();    // m
  bool on_packing = false;      // point.z is the top of the highest packing
  Vec3 normal = Vec3::UnitZ();  // unit vector, from the tool into the powder; of a punch: its axis
  double diameter = 0;          // m, of a die, of a punch
  std::optional<double> height =
      {};               // m, of a die whose hole ends: its mouth, from `point` along the normal
  double rounding = 0;  // m, radius of the edge of that mouth
  std::vector<Vec2> profile =
      {};  // m, of a punch: radius, height along the normal; from the axis outward
  std::string file = {}, unit = {};
  // m, relative to `point`, of an STL tool, set once it has been read.
  std::vector<std::array<Vec3, 3>> triangles = {};
  SourceMark mark;
};

struct SpaceScene {
  std::vector<ParticleSpec> particles;
  std::vector<BodySpec> bodies;
  std::vector<PackingSpec> packings;
  std::vector<ToolSpec> tools;
};

}  // namespace pulvis::space
