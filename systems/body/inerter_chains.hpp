// Access to the chains of nodes with inerters (inerter_kernel.hpp).
#pragma once

#include <array>
#include <type_traits>

#include "components/inerter_chains.hpp"
#include "engine/entry.hpp"
#include "systems/body/inerter_kernel.hpp"

namespace pulvis {

using InerterChain = InerterChains::Chain;

// What the outer node of a link has relative to the inner one; `of(i, k)` of the i-th node of the chain.
template <class D, class Of>
auto difference(int link, const Of& of) {
  std::array<Lane, D::axes> d;
  for (int k = 0; k < D::axes; ++k) entry(d, k) = of(link, k) - of(link + 1, k);
  return d;
}
template <class Nodes>
auto of_chain(const InerterChain& chain, const Nodes& nodes) {
  return [&](int i, int k) -> Lane { return nodes(entry(chain.nodes, i), k); };
}

// Calls act(links) with the number of its inerters as a constant.
template <class Act>
void with_links(const InerterChain& chain, const Act& act) {
  if (chain.links == 1)
    act(std::integral_constant<int, 1>());
  else
    act(std::integral_constant<int, 2>());
}

template <class D, int Nodes>
using OfNodes = std::array<std::array<Lane, D::axes>, Nodes>;

// Forces of the inerters of a chain on its nodes. x [m], v [m/s], a [m/s^2] without inerters, of the i-th node of the chain
// along axis k; `mass_per_size` kg over the size of a node, and its inverse.
template <class D, int Links, class X, class V, class A>
OfNodes<D, Links + 1> forces_of_inerters(const InerterChain& chain, double c,
                                         const Lane& mass_per_size, const Lane& size_per_mass,
                                         const X& x, const V& v, const A& a) {
  const auto inerter = [&](int link, const auto& line) {
    return kernels::inerter(line, difference<D>(link, v), difference<D>(link, a),
                            Lane(mass_per_size * (c * entry(chain.reduced, link))));
  };
  const auto line = difference<D>(0, x);
  const auto first = inerter(0, line);
  OfNodes<D, Links + 1> on;
  if constexpr (Links == 1) {
    const Lane pull = kernels::inerter_force(first);
    for (int k = 0; k < D::axes; ++k) {
      entry(on[0], k) = pull * entry(line, k);
      entry(on[1], k) = -entry(on[0], k);
    }
  } else {
    const auto next = difference<D>(1, x);
    const auto pull = kernels::inerter_forces(
        first, inerter(1, next),
        Lane(kernels::dot(line, next) * (chain.inv_shared * size_per_mass)));
    for (int k = 0; k < D::axes; ++k) {
      entry(on[0], k) = pull[0] * entry(line, k);
      entry(on[2], k) = -(pull[1] * entry(next, k));
      entry(on[1], k) = -(entry(on[0], k) + entry(on[2], k));
    }
  }
  return on;
}

// Their kinetic energy, J.
template <class D, class Positions, class Velocities>
Lane energy_of_inerters(const typename D::Shape& shape, double c, const Lane& mass_per_size,
                        const Positions& x, const Velocities& v) {
  Lane total{};
  for (const InerterChain& chain : shape.chains.all)
    for (int link = 0; link < chain.links; ++link)
      total += kernels::inerter_energy<Lane>(difference<D>(link, of_chain(chain, x)),
                                             difference<D>(link, of_chain(chain, v)),
                                             mass_per_size * entry(chain.reduced, link), c);
  return total;
}

}  // namespace pulvis
