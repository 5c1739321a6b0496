// initial_bonds: bonds surfaces that touch at the start, in three dimensions.
//
// Law      as in two dimensions (systems/contact/initial_bonds.cpp): a point within `reach` of its closest point on a
//          surface that faces it; an initial gap belongs to the bond and carries no force. So does an initial overlap,
//          which smooth surfaces of coarse meshes can have although the shapes only touch: it is bonded at any depth
// Runs     once, at the start, after the first narrow phase, which finds the closest points
// Active   when the scene has bonds between particles that exist from the start
#include <algorithm>
#include <cmath>

#include "systems/contact/bond_strength.hpp"
#include "systems/space/contact/patch_kernel.hpp"
#include "systems/space/contact/systems.hpp"

namespace pulvis::space {
namespace {

using Slopes = kernels::PatchSlopes<double>;
using Vec = kernels::Vector<double>;

Vec normal_of(const Slopes& s) {
  const Vec n = cross(s.u, s.v);
  return (1 / std::sqrt(dot(n, n))) * n;
}

// A point beside the surface, past an edge, is not a neighbour.
constexpr double beside = 1e-3;  // of the size of the face
constexpr double facing = -0.5;  // product of the normals

}  // namespace

void initial_bonds::operator()() const {
  const double* control = position.values().data();
  const auto patch = [&](int slot, int face) {
    return PatchNumbers{control + bodies.outline_begin(slot),
                        entry(bodies.shape_of(slot).faces, face).number.data()};
  };
  for (int r = 0; r < rows.pair.rows(); ++r) {
    const Row<FaceContact> row(r);
    const int slot = rows.pair(row, 0), face = rows.pair(row, 1), other = rows.pair(row, 2);
    if (!bodies.bodies->owns(slot)) continue;
    const auto &a = entry(bodies.bodies->slots, slot), &b = entry(bodies.bodies->slots, other);
    const int number = rows.rules->initial_between(a, b);
    if (number == 0) continue;
    const BondRules::Law& law = rows.rules->law(number);
    const double size = entry(bodies.shape_of(slot).faces, face).size;
    const double strength = drawn_strength(law, a.number, b.number);
    const Point shift = images ? images->shift(row) : Point{};
    for (int g = 0; g < face_points; ++g) {
      const Slopes own = kernels::patch_slopes<double>(
          patch(slot, face), entry(kernels::gauss_at, g % 4), entry(kernels::gauss_at, g / 4));
      const double* closest = &point(row, ContactPoint::numbers * g);
      const double its = std::floor(closest[ContactPoint::face_u]);
      const Slopes there = kernels::patch_slopes<double>(patch(other, static_cast<int>(its)),
                                                         closest[ContactPoint::face_u] - its,
                                                         closest[ContactPoint::v]);
      const Vec n = normal_of(there), d = own.x - Vec{shift[0], shift[1], shift[2]} - there.x;
      const double opening = dot(d, n);
      const Vec along = d - opening * n;
      if (dot(along, along) > beside * beside * size * size || dot(n, normal_of(own)) > facing)
        continue;
      entry(totals->nearest, number - 1).take(std::max(opening, 0.0), size);
      if (opening > law.reach * size) continue;
      rows.make(row, g, strength, opening);
      activation(row, g) = 0;
      entry(totals->made, number - 1) += 1;
    }
  }
}

}  // namespace pulvis::space
