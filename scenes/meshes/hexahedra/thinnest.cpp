#include "scenes/meshes/hexahedra/thinnest.hpp"

#include <algorithm>
#include <limits>

#include "scenes/spec/scene.hpp"

namespace pulvis::space {
namespace {

using Axes = std::array<Vec3, 3>;

// dX/d(xi, eta, zeta) at the centre, times two: the edges there.
Axes middle_axes(const Shape& shape, const std::array<Row<Node>, 8>& hexahedron) {
  Axes axes{Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  for (int corner = 0; corner < 8; ++corner) {
    const Point& p = entry(shape.nodes, entry(hexahedron, corner));
    for (int k = 0; k < 3; ++k)
      entry(axes, k) += Shape::mode_sign(k, corner) / 4 * Vec3(p[0], p[1], p[2]);
  }
  return axes;
}

}  // namespace

double thinnest_part(const Shape& shape) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& hexahedron : shape.hexahedra) {
    const Axes a = middle_axes(shape, hexahedron);
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 across = a[(k + 1) % 3].cross(a[(k + 2) % 3]);
      least = std::min(least, a[k].dot(across) / across.norm());
    }
  }
  return least;
}

}  // namespace pulvis::space
