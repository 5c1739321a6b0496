// integrate: leapfrog with a variable time step (T 5.4, 5.5):
//   v_(n+1/2) = v_(n-1/2) + a_n (dt_before + dt) / 2,   x_(n+1) = x_n + v_(n+1/2) dt
// with a = (internal + contact force) / lumped mass, and inerters at the boundary (inerter_kernel.hpp).
//
// Runs     after all forces of the step
#include <array>

#include "components/run_state.hpp"
#include "engine/access.hpp"
#include "engine/entry.hpp"
#include "systems/body/boundary_pairs.hpp"
#include "systems/body/nodal_force.hpp"
#include "systems/body/systems.hpp"

namespace pulvis {
namespace {

// a b + c: rounded twice in two dimensions, once in three. One form for both would change the bits of one of them.
template <class D, class Factor>
Lane product_sum(const Lane& a, const Factor& b, const Lane& c) {
  if constexpr (D::axes == 2)
    return c + a * b;
  else
    return fma(a, b, c);
}

}  // namespace

template <class D>
[[gnu::flatten]] void integrate<D>::operator()(Chunk chunk) const {
  const auto& shape = bodies.shape_of(chunk);
  const auto v = velocity.chunk(chunk);
  const auto x = position.chunk(chunk);
  const double dt = clock->dt;
  const Lane mass_per_size = density.chunk(chunk)(Row<Particle>()) * bodies.depth();
  const double time = 0.5 * (clock->dt_before + dt), inv_time = 1 / time;
  const Lane kick = time / mass_per_size;
  const auto move = [&](Row<Node> n, int k, const Lane& by, const Lane& f) {
    const Lane next = product_sum<D>(f, by, v(n, k));
    v(n, k) = next;
    x(n, k) = product_sum<D>(next, dt, x(n, k));
  };
  const auto kick_of = [&](int n) -> Lane { return kick * (1 / shape.size_of_node(n)); };

  const NodalForce<D> force(forces, shape, chunk);
  const auto move_freely = [&](Row<Node> n) {
    const Lane by = kick_of(n.value);
    for (int k = 0; k < D::axes; ++k) move(n, k, by, force(n, k));
  };
  if (!inertance || (*inertance)->inertance == 0) {
    for (int n = 0; n < static_cast<int>(shape.nodes.size()); ++n) move_freely(Row<Node>(n));
    return;
  }
  const double c = (*inertance)->inertance;
  for (const BoundaryPairs::Pair& pair : shape.pairs.all) {
    const Lane outer = kick_of(pair.outer.value), inner = kick_of(pair.inner.value);
    const auto line = difference<D>(pair, x);
    std::array<Lane, D::axes> on_outer, on_inner, acceleration;
    for (int k = 0; k < D::axes; ++k) {
      entry(on_outer, k) = force(pair.outer, k);
      entry(on_inner, k) = force(pair.inner, k);
      entry(acceleration, k) = inv_time * (outer * entry(on_outer, k) - inner * entry(on_inner, k));
    }
    const Lane pull = kernels::inerter_force(line, difference<D>(pair, v), acceleration,
                                             Lane(mass_per_size * (c * reduced_size(pair, shape))));
    for (int k = 0; k < D::axes; ++k) {
      const Lane along = pull * entry(line, k);
      move(pair.outer, k, outer, entry(on_outer, k) + along);
      move(pair.inner, k, inner, entry(on_inner, k) - along);
    }
  }
  for (const Row<Node> n : shape.pairs.single) move_freely(n);
}
template struct integrate<TwoD>;
template struct integrate<ThreeD>;

}  // namespace pulvis
