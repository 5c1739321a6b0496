#include "scenes/meshes/hexahedra/star_surface.hpp"

#include <cmath>
#include <numbers>

#include "engine/portable_math.hpp"
#include "scenes/meshes/hexahedra/round_surfaces.hpp"
#include "scenes/meshes/hexahedra/rounded_polyhedron.hpp"
#include "scenes/meshes/hexahedra/star_triangles.hpp"

namespace pulvis::space {
namespace {

std::unique_ptr<StarSurface> round_surface(const PolyhedronShape& shape) {
  return polyhedron_surface(shape);
}
std::unique_ptr<StarSurface> round_surface(const StlShape& shape) {
  return triangle_surface(shape);
}

// Equiangular on a sphere: its faces are of similar size.
Vec3 on_square_box(const Vec3& on_cube) {
  return (std::numbers::pi / 4 * on_cube).unaryExpr([](double a) { return portable::tan(a); });
}

// The cube with its sections mapped to circles: edges that run around the z axis are placed on the rims of a cylinder.
// (Fong, Analytical methods for squaring the disc, 2014: elliptical grid.)
Vec3 on_round_box(const Vec3& on_cube) {
  const auto even = [](double a) {
    return std::numbers::sqrt2 * portable::sin(std::numbers::pi / 4 * a);
  };
  const double x = even(on_cube.x()), y = even(on_cube.y());
  return {x * std::sqrt(1 - y * y / 2), y * std::sqrt(1 - x * x / 2), on_cube.z()};
}

}  // namespace

Vec3 StarSurface::direction_of(const Vec3& on_cube) const {
  const Vec3 square = on_square_box(on_cube), round = on_round_box(on_cube);
  const double share = roundness();
  const Vec3 on_box = (1 - share) * square + share * round;
  return on_box.cwiseProduct(half_size()).normalized();
}

std::unique_ptr<StarSurface> star_surface(const ParticleShape& shape) {
  return std::visit([](const auto& s) { return round_surface(s); }, shape);
}

}  // namespace pulvis::space
