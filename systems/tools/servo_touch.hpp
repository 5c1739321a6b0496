// Contacts of a servo-driven part: springs and dashpots of a row's points, as if all pointed in its direction.
#pragma once

#include <array>
#include <cmath>

#include "components/bundles.hpp"
#include "systems/laws/normal_contact.hpp"
#include "systems/tools/servo_kernel.hpp"

namespace pulvis {

// Of a point with this force, N, and area, m^2. `bonds`: their stiffness over that of a contact spring.
template <class At>
kernels::TouchSums touching_at_point(Row<At> row, const Read<ContactLaw<At>>& law,
                                     const std::array<double, At::axes>& force, double area,
                                     double bonds) {
  using Law = ContactLaw<At>;
  double square = 0;
  for (const double part : force) square += part * part;
  const double pressure = std::sqrt(square) / area;
  if (!(pressure > 0)) return {};
  const double kappa = law(row, Law::stiffness);
  const double g_s = kernels::stiffening_depth / law(row, Law::inv_size);
  return {area * kappa * (kernels::tangent_at(pressure, kappa, g_s) + bonds),
          area * law(row, Law::damping)};
}

// For the points currently under pressure. `area(g)`: of a point, m^2.
template <class At, class Area>
kernels::TouchSums touching_of(Row<At> row, const TouchingRows<At>& rows,
                               const Read<ContactLaw<At>>& law, const Area& area, double bonds) {
  kernels::TouchSums sums;
  for (int g = 0; g < At::points; ++g) {
    std::array<double, At::axes> force;
    for (int k = 0; k < At::axes; ++k)
      entry(force, k) = rows.force(row, PointForce<At>::number(g, k));
    sums.include(touching_at_point(row, law, force, area(g), bonds));
  }
  return sums;
}
// Of an edge, whose law has the areas; those of a face are in its shape.
template <class At>
kernels::TouchSums touching_of(const ShapedBodies<TwoD>&, Row<At> row, const TouchingRows<At>& rows,
                               const Read<ContactLaw<At>>& law, double bonds) {
  const auto area = [&](int g) { return law(row, ContactLaw<At>::weight + g); };
  return touching_of(row, rows, law, area, bonds);
}
template <class At>
kernels::TouchSums touching_of(const ShapedBodies<ThreeD>& bodies, Row<At> row,
                               const TouchingRows<At>& rows, const Read<ContactLaw<At>>& law,
                               double bonds) {
  const auto& area = entry(bodies.shape_of(rows.pair(row, 0)).faces, rows.pair(row, 1)).weight;
  return touching_of(
      row, rows, law, [&](int g) { return entry(area, g); }, bonds);
}

}  // namespace pulvis
