// What damping_force has in common for all elements: the force proportional to mass, and the work.
#pragma once

#include <type_traits>

#include "components/run_state.hpp"
#include "engine/access.hpp"
#include "systems/body/systems.hpp"

namespace pulvis {

// Power of nodal forces at nodal velocities v.
template <int Axes, class Forces, class Velocities>
auto power_on_nodes(int nodes, const Forces& force, const Velocities& v) {
  std::remove_cvref_t<decltype(v(Row<Node>(0), 0))> sum{};
  for (int i = 0; i < nodes; ++i)
    for (int k = 0; k < Axes; ++k) sum += force(Row<Node>(i), k) * v(Row<Node>(i), k);
  return sum;
}

// `view_of(column)`: of the particles that are computed at a time, all of the chunk or some of its lanes.
// `add_viscous_forces(force, x, v, beta)`: of the elements, on their nodes.
template <class System, class ViewOf, class AddViscousForces>
void damp(const System& s, Chunk chunk, const ViewOf& view_of,
          const AddViscousForces& add_viscous_forces) {
  constexpr int axes = std::remove_cvref_t<decltype(s.bodies)>::Dimension::axes;
  const Row<Particle> particle;
  const auto& shape = s.bodies.shape_of(chunk);
  const auto nodes = static_cast<int>(shape.nodes.size());
  const auto v = view_of(s.motion.velocity);
  const auto force = view_of(s.damping);
  // The first force acts for half a step (systems/body/integrate.cpp).
  const double start = s.clock->step == 1 ? 0.5 : 1.0;
  const auto before = start * power_on_nodes<axes>(nodes, force, v);

  const auto drag = view_of(s.constants.mass)(particle) * view_of(s.material.density)(particle) *
                    s.bodies.depth();
  for (int i = 0; i < nodes; ++i)
    for (int k = 0; k < axes; ++k)
      force(Row<Node>(i), k) = -(shape.size_of_node(i) * drag) * v(Row<Node>(i), k);

  const auto viscous = view_of(s.constants.stiffness)(particle);
  if (any(viscous > 0.0)) add_viscous_forces(force, view_of(s.motion.position), v, viscous);

  view_of(s.work)(particle) -=
      0.5 * s.clock->dt_before * (before + power_on_nodes<axes>(nodes, force, v));
  const auto f = view_of(s.internal);
  for (int i = 0; i < nodes; ++i)
    for (int k = 0; k < axes; ++k) f(Row<Node>(i), k) += force(Row<Node>(i), k);
}

}  // namespace pulvis
