// tool_servo: velocity of force-controlled tools in the next step, from their current reaction force.
//
// Source   systems/tools/servo_motion.hpp
// Runs     after tool_reaction; tool_motion adds the displacement in the next step
// Active   if a stage of the scene has a servo, or a compliant drive
// Watches  that the force is reached when its stage ends
#include <cmath>

#include "systems/laws/normal_contact.hpp"
#include "systems/space/tools/systems.hpp"
#include "systems/tools/servo_motion.hpp"

namespace pulvis::space {
namespace {

// Over the points of a row that currently press, as if all normals were in the servo's direction. `bonds`: their stiffness
// over that of a contact spring.
kernels::TouchSums touching_of_row(const tool_servo& s, Row<FaceToolContact> row, double bonds) {
  using Law = ContactLaw<FaceToolContact>;
  const Shape::Face& face =
      entry(s.bodies.shape_of(s.rows.pair(row, 0)).faces, s.rows.pair(row, 1));
  const double kappa = s.law(row, Law::stiffness);
  const double g_s = kernels::stiffening_depth / s.law(row, Law::inv_size);
  kernels::TouchSums sums;
  for (int g = 0; g < face_points; ++g) {
    double square = 0;
    for (int k = 0; k < 3; ++k) {
      const double force = s.rows.force(row, k * face_points + g);
      square += force * force;
    }
    const double weight = entry(face.weight, g), pressure = std::sqrt(square) / weight;
    if (!(pressure > 0)) continue;
    sums.stiffness += weight * kappa * (kernels::tangent_at(pressure, kappa, g_s) + bonds);
    sums.damping += weight * s.law(row, Law::damping);
  }
  return sums;
}

}  // namespace

void tool_servo::operator()() const {
  drive_tools(servos, [&](int tool) {
    TouchSum sums;
    for (int r = 0; r < rows.pair.rows(); ++r) {
      const Row<FaceToolContact> row(r);
      if (rows.touches(row) == 0 || rows.pair(row, 2) != tool) continue;
      sums.add(touching_of_row(*this, row, servos.rules->stiffest_weld()));
    }
    return sums.of_ranks(link);
  });
}

}  // namespace pulvis::space
