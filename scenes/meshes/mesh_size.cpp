#include "scenes/meshes/mesh_size.hpp"
#include "scenes/outlines/curve_of.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scenes/meshes/boundary_nodes.hpp"
#include "scenes/meshes/mesh_rounded_rectangle.hpp"

namespace pulvis {
namespace {

using std::numbers::pi;

constexpr double max_count = 1e6;  // beyond any mesh; rejected later

int count_of(double ratio) {
  return static_cast<int>(std::clamp(std::round(ratio), 1.0, max_count));
}

int multiple_of_4(double edges) { return 4 * count_of(edges / 4); }

// With 40 edges, a core of (edges/4)^2 quads and a ring of as many are about as large as their edges; the
// core's share of the radius stays constant with more edges.
int rings_for(int edges) { return std::max(1, count_of(edges / 40.0)); }

void set(DiscMesh& mesh, const DiscOutline& o, double size) {
  mesh.boundary_edges = std::max(8, multiple_of_4(pi * o.diameter / size));
  mesh.rings = rings_for(mesh.boundary_edges);
}
void set(RingMesh& mesh, const RingOutline& o, double size) {
  mesh.boundary_edges = std::max(8, multiple_of_4(pi * o.diameter / size));
  mesh.rings = count_of((o.diameter - o.hole) / 2 / size);
}
void set(RectangleMesh& mesh, const RectangleOutline& o, double size) {
  mesh.columns = count_of(o.width / size);
  mesh.rows = count_of(o.height / size);
}
void set(RoundedRectangleMesh& mesh, const RoundedRectangleOutline& o, double size) {
  const double perimeter = 2 * (o.width + o.height) - (8 - 2 * pi) * o.radius;
  mesh.boundary_edges = std::max(fewest_edges(o), multiple_of_4(perimeter / size));
  mesh.rings = rings_for(mesh.boundary_edges);
}
template <class CurvedOutline>
void set(StarMesh& mesh, const CurvedOutline& o, double size) {
  mesh.boundary_edges = edges_of_size(curve_of(o), size);
  mesh.rings = rings_for(mesh.boundary_edges);
}

}  // namespace

void mesh_of_size(ParticleSpec& particle) {
  if (!particle.mesh_size) return;
  std::visit(
      [&](const auto& outline) {
        using Mesh = typename std::decay_t<decltype(outline)>::Mesh;
        set(std::get<Mesh>(particle.mesh), outline, *particle.mesh_size);
      },
      particle.outline);
}

int fewest_boundary_edges(const Outline& outline) {
  return std::visit(
      [](const auto& o) {
        if constexpr (requires { curve_of(o); })
          return fewest_edges(curve_of(o));
        else if constexpr (requires { fewest_edges(o); })
          return fewest_edges(o);
        else
          return 4;
      },
      outline);
}

}  // namespace pulvis
