<<<<<<< HEAD
// tool_servo: how fast tools that hold a force move in the next step, from the force that they bear now.
//
// Source   systems/tools/servo_motion.hpp
// Runs     after tool_reaction; tool_motion adds the displacement in the next step
// Active   when a stage of the scene has a servo
// Watches  that the force is held when its stage ends
=======
// tool_servo: how fast tools that hold a force move in the next step, from the force that they bear now, in three dimensions.
//
// Source   systems/tools/servo_kernel.hpp, systems/tools/tool_servo.cpp
// Runs     after tool_reaction; tool_motion adds the displacement in the next step
// Active   when a stage of the scene has a servo
>>>>>>> fast3
#include <cmath>

#include "systems/laws/normal_contact.hpp"
#include "systems/space/tools/systems.hpp"
<<<<<<< HEAD
#include "systems/tools/servo_motion.hpp"
=======
>>>>>>> fast3

namespace pulvis::space {
namespace {

<<<<<<< HEAD
// Of a row's points that press now, as if all pointed in the servo's direction.
kernels::TouchSums touching_of_row(const tool_servo& s, Row<FaceToolContact> row) {
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
    sums.stiffness += weight * kappa * kernels::tangent_at(pressure, kappa, g_s);
    sums.damping += weight * s.law(row, Law::damping);
=======
// Springs and dashpots of the points that press on a tool, as if all pointed in its direction.
pulvis::kernels::TouchSums touching_tool(const tool_servo& s, int tool) {
  using Law = ContactLaw<FaceToolContact>;
  pulvis::kernels::TouchSums sums;
  for (int r = 0; r < s.rows.pair.rows(); ++r) {
    const Row<FaceToolContact> row(r);
    if (s.rows.touches(row) == 0 || s.rows.pair(row, 2) != tool) continue;
    const Shape::Face& face =
        entry(s.bodies.shape_of(s.rows.pair(row, 0)).faces, s.rows.pair(row, 1));
    const double kappa = s.law(row, Law::stiffness);
    const double g_s = pulvis::kernels::stiffening_depth * face.size;
    for (int g = 0; g < face_points; ++g) {
      const double weight = entry(face.weight, g);
      const double x = s.rows.force(row, g), y = s.rows.force(row, face_points + g),
                   z = s.rows.force(row, 2 * face_points + g);
      const double pressure = std::sqrt(x * x + y * y + z * z) / weight;
      if (!(pressure > 0)) continue;
      sums.stiffness += weight * kappa * pulvis::kernels::tangent_at(pressure, kappa, g_s);
      sums.damping += weight * s.law(row, Law::damping);
    }
>>>>>>> fast3
  }
  return sums;
}

}  // namespace

void tool_servo::operator()() const {
<<<<<<< HEAD
  drive_tools(servos, [&](int tool) {
    kernels::TouchSums sums;
    for (int r = 0; r < rows.pair.rows(); ++r) {
      const Row<FaceToolContact> row(r);
      if (rows.touches(row) == 0 || rows.pair(row, 2) != tool) continue;
      const kernels::TouchSums one = touching_of_row(*this, row);
      sums.stiffness += one.stiffness;
      sums.damping += one.damping;
    }
    return sums;
  });
=======
  drive_tools(servo, [this](int tool) { return touching_tool(*this, tool); });
>>>>>>> fast3
}

}  // namespace pulvis::space
