// apply_constraints: replaces the force on every constrained node, in the constrained direction, by the one that
// lets the leapfrog reach the prescribed position at t_(n+1), and stores the difference as the reaction.
//
// Source   systems/tools/constraint_kernel.hpp. The reaction is added to the internal force, so that the kinetic
//          energy of the step (systems/body/energies.cpp) includes the force that acted.
// Runs     after all forces of the step, before integrate
// Active   when the scene has constraints
#include "components/run_state.hpp"
#include "components/surface.hpp"
#include "engine/access.hpp"
#include "engine/entry.hpp"
#include "systems/tools/constraint_kernel.hpp"
#include "systems/tools/systems.hpp"

namespace pulvis {
namespace {

// Programmed displacement of a tool from its initial position.
Point3 tool_travel(const ToolProgram& program, int tool, double time) {
  const Point3 now = tool_position_at(program, tool, time);
  const Point3& start = entry(program.start, tool);
  return {now[0] - start[0], now[1] - start[1], now[2] - start[2]};
}

}  // namespace

template <class D>
void apply_constraints<D>::operator()(Chunk chunk) const {
  const auto& shape = bodies.shape_of(chunk);
  const auto x = motion.position.chunk(chunk);
  const auto v = motion.velocity.chunk(chunk);
  const auto f = forces.internal.chunk(chunk);
  const auto c = static_cast<std::size_t>(chunk.index);
  const double kick = 0.5 * (clock->dt_before + clock->dt);
  int tool = -1;
  Point3 displacement{};
  for (int r = constraints.index->begin[c]; r < constraints.index->begin[c + 1]; ++r) {
    const Row<ConstrainedNode> row(r);
    const Row<Node> node(constraints.target(row, 0));
    const int lane = constraints.target(row, 1);
    if (constraints.target(row, 2) != tool) {
      tool = constraints.target(row, 2);
      displacement = tool_travel(*program, tool, clock->time + clock->dt);
    }
    const double mass = density.chunk(chunk)(Row<Particle>())[lane] * bodies.depth() *
                        shape.size_of_node(node.value);
    double at = 0, speed = 0, free = 0;
    for (int k = 0; k < D::axes; ++k) {
      const double d = constraints.direction(row, k);
      at += d * x(node, k)[lane];
      speed += d * v(node, k)[lane];
      free += d * f(node, k)[lane];
      if (forces.contact && node.value < shape.boundary_nodes)
        free += d * forces.contact->chunk(chunk)(Row<BoundaryNode>(node.value), k)[lane];
    }
    double place = constraints.origin(row);
    for (std::size_t k = 0; k < D::axes; ++k)
      place += constraints.travel(row, static_cast<int>(k)) * displacement[k];
    const double held = kernels::constraint_force(place, at, speed, free, mass, kick, clock->dt);
    for (int k = 0; k < D::axes; ++k) f(node, k)[lane] += held * constraints.direction(row, k);
    reaction.chunk(chunk)(Row<ConstrainedNode>(r - constraints.index->begin[c])) = held;
  }
}
template struct apply_constraints<TwoD>;
template struct apply_constraints<ThreeD>;

}  // namespace pulvis
