#include "scenes/meshes/hexahedra/mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "engine/activity.hpp"
#include "engine/result_cache.hpp"
#include "scenes/meshes/hexahedra/cubed_sphere.hpp"
#include "scenes/meshes/hexahedra/element_constants.hpp"
#include "scenes/meshes/hexahedra/extruded_disc.hpp"
#include "scenes/meshes/hexahedra/mesh_axes.hpp"
#include "scenes/meshes/hexahedra/smooth_hexahedra.hpp"
#include "scenes/meshes/hexahedra/smooth_surface.hpp"
#include "scenes/meshes/hexahedra/true_volume.hpp"

namespace pulvis::space {
namespace {

constexpr Smoothing smoothing{0.5, 200};

// Moves the surface nodes, which come first.
void make_surface_true(std::vector<Vec3>& nodes, int surface_nodes,
                       const std::vector<std::array<int, 4>>& quads, const StarSurface& surface) {
  std::vector<Vec3> outer(nodes.begin(), nodes.begin() + surface_nodes);
  make_volume_true(outer, quads, surface);
  std::ranges::copy(outer, nodes.begin());
}

class Mesher {
 public:
  Mesher(const HexMeshSpec& mesh, const StarSurface& surface)
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
  // Layers of uniform thickness around a core shaped between a cube and a sphere, with its share of all layers.
  void start() {
    const Vec3 half = surface_.half_size();
    const Vec3 core = core_size();
    const auto in_core = [&](const Vec3& on_cube) {
      const double out = on_cube.cwiseAbs().maxCoeff();
      if (out == 0) return Vec3(Vec3::Zero());
      const Vec3 round = surface_.point(surface_.direction_of(on_cube / out)) * out;
      return Vec3(core.cwiseProduct(0.5 * round + 0.35 * on_cube.cwiseProduct(half)));
    };
    for (int layer = 0; layer < grid_.rings(); ++layer)
      for (const Lattice& at : grid_.rim()) {
        const Vec3 on_cube = place_on_cube(at);
        const double share = static_cast<double>(layer) / grid_.rings();
        nodes_.push_back((1 - share) * surface_.point(surface_.direction_of(on_cube)) +
                         share * in_core(on_cube));
      }
    for (int i = grid_.core_node({0, 0, 0}); i < grid_.nodes(); ++i)
      nodes_.push_back(in_core(place_on_cube(grid_.core_point(i - grid_.core_node({0, 0, 0})))));
  }

  Vec3 place_on_cube(const Lattice& at) const {
    const std::array<double, 3> place = grid_.on_cube(at);
    return {place[0], place[1], place[2]};
  }

  // Relative to the size of the shape.
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
  shape.boundary_nodes = surface_nodes;
  shape.hexahedra = hexahedra;
}

void mesh_on_cube(const HexMeshSpec& mesh, const StarSurface& surface, Shape& shape) {
  Mesher mesher(mesh, surface);
  set_mesh(shape, mesher.nodes(), mesher.surface_nodes(), mesher.hexahedra());
}

// Its elements are uniform from the start.
void mesh_by_extrusion(const CylinderShape& cylinder, const HexMeshSpec& mesh,
                       const StarSurface& surface, Shape& shape) {
  ExtrudedDisc disc = extruded_disc(cylinder, mesh, surface);
  make_surface_true(disc.nodes, disc.surface_nodes, disc.quads, surface);
  set_mesh(shape, disc.nodes, disc.surface_nodes, disc.hexahedra);
}

// As seen from the axes of the mesh, if they differ from the shape's own.
using Seen = const TurnedSurface*;

// Everything that follows from `nodes` and `hexahedra`.
void complete(Shape& shape, const StarSurface& surface) {
  shape.true_volume = surface.volume();
  complete_elements(shape);  // the stiffness of the faces needs the elements' volumes,
  complete_surface(shape, surface);
  complete_elements(shape);  // and the contact frequencies need the faces
}

Shape shape_on_cube(const HexMeshSpec& mesh, const StarSurface& surface, Seen seen) {
  Shape shape;
  mesh_on_cube(mesh, seen ? *seen : surface, shape);
  if (seen)
    for (Point& p : shape.nodes) {
      const Vec3 at = seen->in_own_axes({p[0], p[1], p[2]});
      p = {at.x(), at.y(), at.z()};
    }
  complete(shape, surface);
  return shape;
}

// A polyhedron or a scan has an arbitrary orientation in its file. The cube is rotated to where contacts see the shape
// best; it stays along the shape's own axes if the gain is small.
Shape shape_on_fitting_cube(const HexMeshSpec& mesh, const StarSurface& surface) {
  constexpr double clearly = 0.8;
  std::optional<Shape> best;
  double best_error = std::numeric_limits<double>::infinity();
  const auto try_along = [&](Seen seen, double less_than) {
    try {
      Shape shape = shape_on_cube(mesh, surface, seen);
      if (!(shape.surface_error < less_than)) return;
      best_error = shape.surface_error;
      best = std::move(shape);
    } catch (const std::invalid_argument&) {  // folded
    }
  };
  try_along(nullptr, best_error);
  for (const TurnedSurface& seen : turned_to_fit(surface, mesh.divisions))
    try_along(&seen, clearly * best_error);
  return best ? *std::move(best) : shape_on_cube(mesh, surface, nullptr);
}

struct ShapeKey {
  ParticleShape shape;
  HexMeshSpec mesh;
  bool operator==(const ShapeKey&) const = default;
};

// `axial_divisions` are along the shape's local z.
bool has_free_axes(const ShapeKey& of) {
  return !of.mesh.axial_divisions && (std::holds_alternative<PolyhedronShape>(of.shape) ||
                                      std::holds_alternative<StlShape>(of.shape));
}

Shape shape_of(const ShapeKey& of) {
  const auto& [true_shape, mesh] = of;
  const Activity meshing(fmt::format("mesh of {} elements for a particle", mesh.hexahedra()));
  const std::unique_ptr<StarSurface> surface = star_surface(true_shape);
  if (has_free_axes(of)) return shape_on_fitting_cube(mesh, *surface);
  if (mesh.grid == HexMeshSpec::Grid::cube) return shape_on_cube(mesh, *surface, nullptr);
  Shape shape;
  mesh_by_extrusion(std::get<CylinderShape>(true_shape), mesh, *surface, shape);
  complete(shape, *surface);
  return shape;
}

std::size_t bytes_of(const Shape& shape) {
  return shape.hexahedra.size() *
         (sizeof(shape.hexahedra[0]) + sizeof(shape.element[0]) + sizeof(shape.gauss[0]));
}

}  // namespace

Shape make_shape(const ParticleSpec& particle) {
  // Packings, the particle layout, the summary and the warnings of a scene request the same shapes, and so do the
  // runs of a study. The largest mesh that a scene may have (scenes/checks/solids/solid_particles.cpp) needs 150 MB.
  static ResultCache<ShapeKey, Shape> cache(320 << 20);  // bytes, approximately
  const auto size = [&](const Shape& made) { return stl_bytes(particle.shape) + bytes_of(made); };
  Shape shape = cache.get({particle.shape, particle.hex_mesh}, shape_of, size);
  shape.name = particle.name;
  return shape;
}

}  // namespace pulvis::space
