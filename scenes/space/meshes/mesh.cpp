#include "scenes/space/meshes/mesh.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "engine/portable_math.hpp"
#include "scenes/space/meshes/cubed_sphere.hpp"
#include "scenes/space/meshes/element_constants.hpp"
#include "scenes/space/meshes/extruded_disc.hpp"
#include "scenes/space/meshes/smooth_hexahedra.hpp"
#include "scenes/space/meshes/smooth_surface.hpp"
#include "scenes/space/meshes/true_volume.hpp"

namespace pulvis::space {
namespace {

constexpr Smoothing smoothing{0.5, 200};

// In [-1, 1]^3.
Vec3 cube_place(const CubedSphere& grid, const Lattice& at) {
  const auto along = [&](int axis) { return 2.0 * entry(at, axis) / grid.divisions(axis) - 1; };
  return {along(0), along(1), along(2)};
}

// Equiangular on a ball: its faces are of similar size.
Vec3 on_square_box(const Vec3& on_cube) {
  return (std::numbers::pi / 4 * on_cube).unaryExpr([](double a) { return portable::tan(a); });
}

// The cube with its sections drawn into circles: edges that run around the z axis come to lie on the rims of a cylinder.
// (Fong, Analytical methods for squaring the disc, 2014: elliptical grid.)
Vec3 on_round_box(const Vec3& on_cube) {
  const auto even = [](double a) {
    return std::numbers::sqrt2 * portable::sin(std::numbers::pi / 4 * a);
  };
  const double x = even(on_cube.x()), y = even(on_cube.y());
  return {x * std::sqrt(1 - y * y / 2), y * std::sqrt(1 - x * x / 2), on_cube.z()};
}

// Where a point of the cube's surface is projected onto the true one.
Vec3 direction_of(const Vec3& on_cube, const StarSurface& surface) {
  const Vec3 square = on_square_box(on_cube), round = on_round_box(on_cube);
  const double share = surface.roundness();
  const Vec3 on_box = (1 - share) * square + share * round;
  return on_box.cwiseProduct(surface.half_size()).normalized();
}

// Moves the nodes of the surface, the first ones.
void make_surface_true(std::vector<Vec3>& nodes, int surface_nodes,
                       const std::vector<std::array<int, 4>>& quads, const StarSurface& surface) {
  std::vector<Vec3> outer(nodes.begin(), nodes.begin() + surface_nodes);
  make_volume_true(outer, quads, surface);
  std::ranges::copy(outer, nodes.begin());
}

class Mesher {
 public:
  Mesher(const MeshSpec& mesh, const StarSurface& surface)
      : grid_({mesh.divisions, mesh.divisions, mesh.axial()}, mesh.rings),
        surface_(surface),
        hexahedra_(grid_.hexahedra()) {}

  std::vector<Vec3> nodes() {
    start();
    make_surface_true(nodes_, grid_.layer_nodes(), grid_.quads(), surface_);
    smooth_hexahedra(nodes_, hexahedra_, grid_.layer_nodes(), smoothing);
    return nodes_;
  }
  const std::vector<Hexahedron>& hexahedra() const { return hexahedra_; }
  int surface_nodes() const { return grid_.layer_nodes(); }

 private:
  // Layers of even thickness about a core between a cube and a ball, which takes its share of all layers.
  void start() {
    const Vec3 half = surface_.half_size();
    const Vec3 core = core_size();
    const auto in_core = [&](const Vec3& on_cube) {
      const double out = on_cube.cwiseAbs().maxCoeff();
      if (out == 0) return Vec3(Vec3::Zero());
      const Vec3 round = surface_.point(direction_of(on_cube / out, surface_)) * out;
      return Vec3(core.cwiseProduct(0.5 * round + 0.35 * on_cube.cwiseProduct(half)));
    };
    for (int layer = 0; layer < grid_.rings(); ++layer)
      for (const Lattice& at : grid_.rim()) {
        const Vec3 on_cube = cube_place(grid_, at);
        const double share = static_cast<double>(layer) / grid_.rings();
        nodes_.push_back((1 - share) * surface_.point(direction_of(on_cube, surface_)) +
                         share * in_core(on_cube));
      }
    for (int i = grid_.core_node({0, 0, 0}); i < grid_.nodes(); ++i)
      nodes_.push_back(
          in_core(cube_place(grid_, grid_.core_point(i - grid_.core_node({0, 0, 0})))));
  }

  // Over the size of the shape.
  Vec3 core_size() const {
    Vec3 core;
    for (int axis = 0; axis < 3; ++axis) {
      const double n = grid_.divisions(axis);
      core[axis] = n / (n + 2 * grid_.rings());
    }
    return core;
  }

  CubedSphere grid_;
  const StarSurface& surface_;
  std::vector<Hexahedron> hexahedra_;
  std::vector<Vec3> nodes_;
};

void set_mesh(Shape& shape, const std::vector<Vec3>& nodes, int surface_nodes,
              const std::vector<Hexahedron>& hexahedra) {
  for (const Vec3& p : nodes) shape.nodes.push_back({p.x(), p.y(), p.z()});
  shape.surface_nodes = surface_nodes;
  shape.hexahedra = hexahedra;
}

void mesh_on_cube(const MeshSpec& mesh, const StarSurface& surface, Shape& shape) {
  Mesher mesher(mesh, surface);
  set_mesh(shape, mesher.nodes(), mesher.surface_nodes(), mesher.hexahedra());
}

// Its elements are even from the start.
void mesh_by_extrusion(const CylinderShape& cylinder, const MeshSpec& mesh,
                       const StarSurface& surface, Shape& shape) {
  ExtrudedDisc disc = extruded_disc(cylinder, mesh, surface);
  make_surface_true(disc.nodes, disc.surface_nodes, disc.quads, surface);
  set_mesh(shape, disc.nodes, disc.surface_nodes, disc.hexahedra);
}

}  // namespace

Shape make_shape(const ParticleSpec& particle) {
  const std::unique_ptr<StarSurface> surface = star_surface(particle.shape);
  Shape shape;
  shape.name = particle.name;
  if (particle.mesh.grid == MeshSpec::Grid::extruded)
    mesh_by_extrusion(std::get<CylinderShape>(particle.shape), particle.mesh, *surface, shape);
  else
    mesh_on_cube(particle.mesh, *surface, shape);
  shape.true_volume = surface->volume();
  complete_elements(shape);  // the stiffness of the faces is made of the elements' volumes,
  complete_surface(shape, *surface);
  complete_elements(shape);  // and the contact's frequencies of the faces
  return shape;
}

}  // namespace pulvis::space
