#include "scenes/space/meshes/star_surface.hpp"

#include "scenes/space/meshes/round_surfaces.hpp"
#include "scenes/space/meshes/rounded_polyhedron.hpp"
#include "scenes/space/meshes/star_triangles.hpp"

namespace pulvis::space {
namespace {

std::unique_ptr<StarSurface> round_surface(const PolyhedronShape& shape) {
  return polyhedron_surface(shape);
}
std::unique_ptr<StarSurface> round_surface(const StlShape& shape) {
  return triangle_surface(shape);
}

}  // namespace

std::unique_ptr<StarSurface> star_surface(const ParticleShape& shape) {
  return std::visit([](const auto& s) { return round_surface(s); }, shape);
}

}  // namespace pulvis::space
