// integrate: leapfrog with a variable time step (T 5.4, 5.5):
//   v_(n+1/2) = v_(n-1/2) + a_n (dt_before + dt) / 2,   x_(n+1) = x_n + v_(n+1/2) dt
// with a = (internal + contact force) / lumped mass.
//
// Runs     after all forces of the step
#include "components/run_state.hpp"
#include "engine/access.hpp"
#include "engine/entry.hpp"
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
  const auto f = forces.internal.chunk(chunk);
  const auto v = velocity.chunk(chunk);
  const auto x = position.chunk(chunk);
  const double dt = clock->dt;
  const Lane kick =
      0.5 * (clock->dt_before + dt) / (density.chunk(chunk)(Row<Particle>()) * bodies.depth());
  const auto move = [&](Row<Node> n, int k, const Lane& by, const Lane& force) {
    const Lane next = product_sum<D>(force, by, v(n, k));
    v(n, k) = next;
    x(n, k) = product_sum<D>(next, dt, x(n, k));
  };

  int n = 0;
  if (forces.contact) {
    const auto g = forces.contact->chunk(chunk);
    for (; n < shape.boundary_nodes; ++n) {
      const Lane by = kick * (1 / shape.size_of_node(n));
      for (int k = 0; k < D::axes; ++k)
        move(Row<Node>(n), k, by, f(Row<Node>(n), k) + g(Row<BoundaryNode>(n), k));
    }
  }
  for (; n < static_cast<int>(shape.nodes.size()); ++n) {
    const Lane by = kick * (1 / shape.size_of_node(n));
    for (int k = 0; k < D::axes; ++k) move(Row<Node>(n), k, by, f(Row<Node>(n), k));
  }
}
template struct integrate<TwoD>;
template struct integrate<ThreeD>;

}  // namespace pulvis
