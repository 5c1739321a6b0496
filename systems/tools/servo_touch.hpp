// Contacts of a servo-driven part: springs and dashpots of a row's points, as if all pointed in its direction.
#pragma once

#include <cmath>

#include "components/bundles.hpp"
#include "systems/laws/normal_contact.hpp"
#include "systems/tools/servo_kernel.hpp"

namespace pulvis {

// For the points currently under pressure. `bonds`: their stiffness over that of a contact spring.
template <class At>
kernels::TouchSums touching_of(Row<At> row, const TouchingRows<At>& rows,
                               const Read<ContactLaw<At>>& law, double bonds) {
  using Law = ContactLaw<At>;
  kernels::TouchSums sums;
  const double kappa = law(row, Law::stiffness);
  const double g_s = kernels::stiffening_depth / law(row, Law::inv_size);
  for (int g = 0; g < edge_points; ++g) {
    const double weight = law(row, Law::weight + g);
    const double x = rows.force(row, 2 * g), y = rows.force(row, 2 * g + 1);
    const double pressure = std::sqrt(x * x + y * y) / weight;
    if (!(pressure > 0)) continue;
    sums.stiffness += weight * kappa * (kernels::tangent_at(pressure, kappa, g_s) + bonds);
    sums.damping += weight * law(row, Law::damping);
  }
  return sums;
}

}  // namespace pulvis
