// integrate: leapfrog with variable time step (T 5.4, 5.5):
//   v_(n+1/2) = v_(n-1/2) + a_n (dt_before + dt) / 2,   x_(n+1) = x_n + v_(n+1/2) dt
// with a = (internal + contact force) / lumped mass.
//
// Runs     after all forces of the step
#include "components/run_state.hpp"
#include "engine/access.hpp"
#include "engine/entry.hpp"
#include "systems/space/body/systems.hpp"

namespace pulvis::space {

[[gnu::flatten]] void integrate::operator()(Chunk chunk) const {
  const Shape& shape = bodies.shape_of(chunk);
  const auto f = forces.internal.chunk(chunk);
  const auto v = velocity.chunk(chunk);
  const auto x = position.chunk(chunk);
  const double dt = clock->dt;
  const Lane kick = 0.5 * (clock->dt_before + dt) / density.chunk(chunk)(Row<Particle>());
  const auto move = [&](Row<Node> n, int k, const Lane& by, Lane force) {
    const Lane next = fma(force, by, v(n, k));
    v(n, k) = next;
    x(n, k) = fma(next, dt, x(n, k));
  };

  int n = 0;
  if (forces.contact) {
    const auto g = forces.contact->chunk(chunk);
    for (; n < shape.surface_nodes; ++n) {
      const Lane by = kick * (1 / entry(shape.nodal_volume, n));
      for (int k = 0; k < 3; ++k)
        move(Row<Node>(n), k, by, f(Row<Node>(n), k) + g(Row<BoundaryNode>(n), k));
    }
  }
  for (; n < static_cast<int>(shape.nodes.size()); ++n) {
    const Lane by = kick * (1 / entry(shape.nodal_volume, n));
    for (int k = 0; k < 3; ++k) move(Row<Node>(n), k, by, f(Row<Node>(n), k));
  }
}

}  // namespace pulvis::space
