// probe_contact: positions of the probe's points relative to the target, and how well their forces satisfy
// the contact law there. commit_contact: the state they carry over to the next increment.
//
// Source   systems/lever/probe_contact_kernel.hpp; distances and normals come from the target's shape
// Runs     before residual, in every evaluation of an equilibrium iteration; after an increment
// Active   when the scene has a surface
#include "systems/lever/solid_contact_problem.hpp"
#include "systems/lever/solid_systems.hpp"

namespace pulvis {

void probe_contact::operator()() const {
  // With a thousandth of the penalties, round-off in a position matters as little as it does in the solid.
  constexpr double rho = 1e-3;
  for (int i = 0; i < probe.node.rows(); ++i) {
    const Row<ProbePoint> row(i);
    const Eigen::Vector3d place = probe_place(probe.node(row), configuration, *target);
    const ContactPoint point = contact_point(row, place, *target, probe);
    const auto at = place_on(*target->shape, point, target->end_radius, place);
    const auto r = kernels::probe_equation(
        point.law, at, point.force, rho * probe.stiffness(row, 0), rho * probe.stiffness(row, 1));
    state(row, 0) = at.gap;
    state(row, 1) = r.pressing;
    state(row, 2) = r.limit;
    state(row, 3) = static_cast<double>(r.state);
    state(row, 4) = r.residual.norm();
  }
}

void commit_contact::operator()() const {
  for (int i = 0; i < node.rows(); ++i) {
    const Row<ProbePoint> row(i);
    const Eigen::Vector3d place = probe_place(node(row), configuration, *target);
    const Eigen::Vector3d f(force(row, 0), force(row, 1), force(row, 2));
    const auto normal =
        target->shape->nearest({place.x(), place.y(), place.z() + target->end_radius}).normal;
    const Eigen::Vector3d n(normal.data());
    const Eigen::Vector3d along = f - n.dot(f) * n;
    const bool touches = state(row, 3) > 0;
    for (int k = 0; k < 3; ++k) {
      memory(row, k) = touches ? along[k] : 0.0;
      memory(row, 3 + k) = place[k];
    }
    memory(row, 6) = touches ? 1 : 0;
  }
}

}  // namespace pulvis
