// probe_contact: the target's forces on the points of the probe, and how they change with their places.
//
// Source   systems/probe_contact_kernel.hpp; distances and normals come from the target's shape
// Runs     before residual, in every evaluation of an equilibrium iteration
// Active   when the scene has a surface
#include "systems/probe_contact_kernel.hpp"
#include "systems/solid_systems.hpp"

namespace pulvis {

void probe_contact(Read<ReferencePosition> reference, Read<Displacement> displacement,
                   Read<Target> target, Read<ProbeNode> node, Read<ProbeStiffness> stiffness,
                   Read<ProbeShare> share, Read<ProbeMemory> memory, Write<ProbeForce> force,
                   Write<ProbeTangent> tangent, Write<ProbeState> state) {
  for (int i = 0; i < node.rows(); ++i) {
    const Row<ProbePoint> row(i);
    const Row<SolidNode> at(node(row));
    Eigen::Vector3d place, old, before;
    TargetShape::Place centre;
    for (int k = 0; k < 3; ++k) {
      place[k] =
          reference(at, k) + displacement(at, k) - target->position[static_cast<std::size_t>(k)];
      old[k] = memory(row, k);
      before[k] = memory(row, 3 + k);
      centre[static_cast<std::size_t>(k)] = place[k];
    }
    centre[2] += target->end_radius;
    const auto nearest = target->shape->nearest(centre);
    const double pull_off = target->pull_off * share(row);
    const auto r =
        kernels::probe_force({stiffness(row, 0), stiffness(row, 1), target->friction, pull_off,
                              target->range, target->stick},
                             nearest.distance - target->end_radius,
                             Eigen::Vector3d(nearest.normal.data()), old, place - before);
    for (int k = 0; k < 3; ++k) force(row, k) = r.force[k];
    for (int k = 0; k < 9; ++k) tangent(row, k) = r.tangent(k / 3, k % 3);
    state(row, 0) = nearest.distance - target->end_radius;
    state(row, 1) = r.normal_force;
    state(row, 2) = r.limit;
    state(row, 3) = static_cast<double>(r.state);
  }
}

void remember_contact(Read<ReferencePosition> reference, Read<Displacement> displacement,
                      Read<Target> target, Read<ProbeNode> node, Read<ProbeForce> force,
                      Read<ProbeState> state, Write<ProbeMemory> memory) {
  for (int i = 0; i < node.rows(); ++i) {
    const Row<ProbePoint> row(i);
    const Row<SolidNode> at(node(row));
    TargetShape::Place place;
    for (int k = 0; k < 3; ++k)
      place[static_cast<std::size_t>(k)] =
          reference(at, k) + displacement(at, k) - target->position[static_cast<std::size_t>(k)];
    TargetShape::Place centre = place;
    centre[2] += target->end_radius;
    const auto normal = target->shape->nearest(centre).normal;
    double pressed = 0;
    for (int k = 0; k < 3; ++k) pressed += force(row, k) * normal[static_cast<std::size_t>(k)];
    for (int k = 0; k < 3; ++k) {
      const bool touches = state(row, 3) > 0;
      memory(row, k) =
          touches ? force(row, k) - pressed * normal[static_cast<std::size_t>(k)] : 0.0;
      memory(row, 3 + k) = place[static_cast<std::size_t>(k)];
    }
  }
}

}  // namespace pulvis
