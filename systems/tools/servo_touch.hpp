// Contacts of a servo-driven part: springs and dashpots of a row's points, as if all pointed in its direction.
#pragma once

#include <cmath>

#include "components/bundles.hpp"
#include "systems/laws/normal_contact.hpp"
#include "systems/tools/servo_kernel.hpp"

namespace pulvis {

// For the points currently under pressure. `area(g)`: of a point, m^2. `bonds`: their stiffness over that of a contact spring.
template <class At, class Area>
kernels::TouchSums touching_of(Row<At> row, const TouchingRows<At>& rows,
                               const Read<ContactLaw<At>>& law, const Area& area, double bonds) {
  using Law = ContactLaw<At>;
  kernels::TouchSums sums;
  const double kappa = law(row, Law::stiffness);
  const double g_s = kernels::stiffening_depth / law(row, Law::inv_size);
  for (int g = 0; g < At::points; ++g) {
    double square = 0;
    for (int k = 0; k < At::axes; ++k) {
      const double force = rows.force(row, PointForce<At>::number(g, k));
      square += force * force;
    }
    const double weight = area(g), pressure = std::sqrt(square) / weight;
    if (!(pressure > 0)) continue;
    sums.stiffness += weight * kappa * (kernels::tangent_at(pressure, kappa, g_s) + bonds);
    sums.damping += weight * law(row, Law::damping);
  }
  return sums;
}
// Of an edge, whose law has the areas; those of a face are in its shape.
template <class At>
requires(At::axes == 2) kernels::TouchSums
    touching_of(Row<At> row, const TouchingRows<At>& rows, const Read<ContactLaw<At>>& law,
                double bonds) {
  const auto area = [&](int g) { return law(row, ContactLaw<At>::weight + g); };
  return touching_of(row, rows, law, area, bonds);
}

}  // namespace pulvis
