// integrate: leapfrog with a variable time step (T 5.4, 5.5):
//   v_(n+1/2) = v_(n-1/2) + a_n (dt_before + dt) / 2,   x_(n+1) = x_n + v_(n+1/2) dt
// with a = (internal + contact force) / lumped mass, and inerters at the boundary (inerter_kernel.hpp).
//
// Runs     after all forces of the step
#include <array>

#include "components/run_state.hpp"
#include "engine/access.hpp"
#include "engine/entry.hpp"
#include "systems/body/inerter_chains.hpp"
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
  if (!inertance) {
    for (int n = 0; n < static_cast<int>(shape.nodes.size()); ++n) move_freely(Row<Node>(n));
    return;
  }
  const auto c = inertance->chunk(chunk);
  const Lane size_per_mass = 1 / mass_per_size;
  const auto move_chain = [&]<int links>(const InerterChain& chain,
                                         std::integral_constant<int, links>) {
    constexpr int nodes = nodes_of_chain(links);
    std::array<Lane, nodes> by;
    OfNodes<D, links> f;
    for (int i = 0; i < nodes; ++i) {
      entry(by, i) = kick_of(entry(chain.nodes, i).value);
      for (int k = 0; k < D::axes; ++k) entry(entry(f, i), k) = force(entry(chain.nodes, i), k);
    }
    const auto acceleration = [&](int i, int k) -> Lane {
      return inv_time * entry(by, i) * entry(entry(f, i), k);
    };
    const auto pull =
        forces_of_inerters<D, links>(chain, c, mass_per_size, size_per_mass, of_chain(chain, x),
                                     of_chain(chain, v), acceleration);
    for (int i = 0; i < nodes; ++i)
      for (int k = 0; k < D::axes; ++k)
        move(entry(chain.nodes, i), k, entry(by, i),
             entry(entry(f, i), k) + entry(entry(pull, i), k));
  };
  for (const InerterChain& chain : shape.chains.all)
    with_links(chain, [&](auto links) { move_chain(chain, links); });
  for (const Row<Node> n : shape.chains.single) move_freely(n);
}
template struct integrate<TwoD>;
template struct integrate<ThreeD>;

}  // namespace pulvis
