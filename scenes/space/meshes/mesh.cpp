#include "scenes/space/meshes/mesh.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "engine/portable_math.hpp"
#include "scenes/space/meshes/cubed_sphere.hpp"
#include "scenes/space/meshes/element_constants.hpp"
#include "scenes/space/meshes/smooth_hexahedra.hpp"
#include "scenes/space/meshes/smooth_surface.hpp"
#include "scenes/space/meshes/true_volume.hpp"

namespace pulvis::space {
namespace {

constexpr int slides =
    0;  // of the surface nodes, after each of which they are put back onto the surface
constexpr int slide_steps = 15;  // of the descent in between
constexpr Smoothing sliding{0.5, slide_steps}, inside{0.5, 200};

// In [-1, 1]^3.
Vec3 cube_place(const CubedSphere& grid, const Lattice& at) {
  const auto along = [&](int i) { return 2.0 * i / grid.divisions() - 1; };
  return {along(at[0]), along(at[1]), along(at[2])};
}

// Equiangular: faces of a sphere are of similar size. `box`: half the size of the box that is projected.
Vec3 direction_of(const Vec3& on_cube, const Vec3& box) {
  const Vec3 on =
      (std::numbers::pi / 4 * on_cube).unaryExpr([](double a) { return portable::tan(a); });
  return on.normalized().cwiseProduct(box).normalized();
}

class Mesher {
 public:
  Mesher(const MeshSpec& mesh, const StarSurface& surface)
      : grid_(mesh.divisions, mesh.rings), surface_(surface), hexahedra_(grid_.hexahedra()) {}

  std::vector<Vec3> nodes() {
    start();
    for (int i = 0; i < slides; ++i) slide();
    make_surface_true();
    smooth_hexahedra(nodes_, hexahedra_, grid_.layer_nodes(), {}, inside);
    return nodes_;
  }
  const std::vector<Hexahedron>& hexahedra() const { return hexahedra_; }
  int surface_nodes() const { return grid_.layer_nodes(); }

 private:
  // Layers of even thickness about a core between a cube and a ball, which takes its share of all layers.
  void start() {
    const Vec3 half = surface_.half_size();
    const double n = grid_.divisions(), core = n / (n + 2 * grid_.rings());
    const auto in_core = [&](const Vec3& on_cube) {
      const double out = on_cube.cwiseAbs().maxCoeff();
      if (out == 0) return Vec3(Vec3::Zero());
      const Vec3 round = surface_.point(direction_of(on_cube / out, half)) * out;
      return Vec3(core * (0.5 * round + 0.35 * on_cube.cwiseProduct(half)));
    };
    for (int layer = 0; layer < grid_.rings(); ++layer)
      for (const Lattice& at : grid_.rim()) {
        const Vec3 on_cube = cube_place(grid_, at);
        const double share = static_cast<double>(layer) / grid_.rings();
        nodes_.push_back((1 - share) * surface_.point(direction_of(on_cube, half)) +
                         share * in_core(on_cube));
      }
    for (int i = grid_.core_node({0, 0, 0}); i < grid_.nodes(); ++i)
      nodes_.push_back(
          in_core(cube_place(grid_, grid_.core_point(i - grid_.core_node({0, 0, 0})))));
  }

  void slide() {
    std::vector<Vec3> normals;
    for (int i = 0; i < grid_.layer_nodes(); ++i)
      normals.push_back(surface_.normal(entry(nodes_, i).normalized()));
    smooth_hexahedra(nodes_, hexahedra_, grid_.layer_nodes(), normals, sliding);
    for (int i = 0; i < grid_.layer_nodes(); ++i)
      entry(nodes_, i) = surface_.point(entry(nodes_, i).normalized());
  }

  void make_surface_true() {
    std::vector<Vec3> outer(nodes_.begin(), nodes_.begin() + grid_.layer_nodes());
    make_volume_true(outer, grid_.quads(), surface_);
    std::ranges::copy(outer, nodes_.begin());
  }

  CubedSphere grid_;
  const StarSurface& surface_;
  std::vector<Hexahedron> hexahedra_;
  std::vector<Vec3> nodes_;
};

}  // namespace

Shape make_shape(const ParticleSpec& particle) {
  const std::unique_ptr<StarSurface> surface = star_surface(particle.shape);
  Mesher mesher(particle.mesh, *surface);
  Shape shape;
  shape.name = particle.name;
  for (const Vec3& p : mesher.nodes()) shape.nodes.push_back({p.x(), p.y(), p.z()});
  shape.surface_nodes = mesher.surface_nodes();
  shape.hexahedra = mesher.hexahedra();
  shape.true_volume = surface->volume();
  complete_elements(shape);  // the stiffness of the faces is made of the elements' volumes,
  complete_surface(shape, *surface);
  complete_elements(shape);  // and the contact's frequencies of the faces
  return shape;
}

}  // namespace pulvis::space
