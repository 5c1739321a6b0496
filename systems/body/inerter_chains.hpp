// Access to the chains of nodes with inerters (inerter_kernel.hpp).
#pragma once

#include <array>
#include <type_traits>

#include "components/inerter_chains.hpp"
#include "engine/entry.hpp"
#include "systems/body/inerter_kernel.hpp"

namespace pulvis {

using InerterChain = InerterChains::Chain;

// What the first node of a link has relative to the second one; `of(i, k)` of the i-th node of the chain.
template <class D, class Of>
auto difference(int link, int links, const Of& of) {
  std::array<Lane, D::axes> d;
  for (int k = 0; k < D::axes; ++k) entry(d, k) = of(link, k) - of(next_in_chain(link, links), k);
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
  else if (chain.links == 2)
    act(std::integral_constant<int, 2>());
  else
    act(std::integral_constant<int, links_of_ring>());
}

template <class D, int Links>
using OfNodes = std::array<std::array<Lane, D::axes>, nodes_of_chain(Links)>;

// Forces of the inerters of a chain on its nodes. x [m], v [m/s], a [m/s^2] without inerters, of the i-th node of the chain
// along axis k; `c` of the nodes; `mass_per_size` kg over the size of a node, and its inverse.
template <class D, int Links, class Inertances, class X, class V, class A>
OfNodes<D, Links> forces_of_inerters(const InerterChain& chain, const Inertances& c,
                                     const Lane& mass_per_size, const Lane& size_per_mass,
                                     const X& x, const V& v, const A& a) {
  std::array<std::array<Lane, D::axes>, Links> line;
  std::array<kernels::Inerter<Lane>, Links> inerter;
  for (int l = 0; l < Links; ++l) {
    entry(line, l) = difference<D>(l, Links, x);
    entry(inerter, l) = kernels::inerter(
        entry(line, l), difference<D>(l, Links, v), difference<D>(l, Links, a),
        Lane(mass_per_size * (c(entry(chain.nodes, l)) * entry(chain.reduced, l))));
  }
  // Of the links before and after a node.
  const auto coupling = [&](int before, int node) -> Lane {
    return kernels::dot(entry(line, before), entry(line, node)) *
           (entry(chain.inv_size, node) * size_per_mass);
  };
  std::array<Lane, Links> pull;
  if constexpr (Links == 1)
    pull[0] = kernels::inerter_force(inerter[0]);
  else if constexpr (Links == 2)
    pull = kernels::inerter_forces(inerter[0], inerter[1], coupling(0, 1));
  else
    pull = kernels::inerter_ring_forces(
        inerter, {coupling(3, 0), coupling(0, 1), coupling(1, 2), coupling(2, 3)});

  OfNodes<D, Links> on;
  for (int i = 0; i < nodes_of_chain(Links); ++i)
    for (int k = 0; k < D::axes; ++k) {
      const auto force = [&](int l) -> Lane { return entry(pull, l) * entry(entry(line, l), k); };
      constexpr bool ring = Links == links_of_ring;
      const int before = i == 0 ? Links - 1 : i - 1;
      Lane& f = entry(entry(on, i), k);
      if (i == 0 && !ring)
        f = force(i);
      else if (i == Links)
        f = -force(before);
      else
        f = force(i) - force(before);
    }
  return on;
}

// Kinetic energy of the inerters of a chain, J; x [m], v [m/s] of the i-th node of the chain half a step before and after.
template <class D, class Inertances, class X, class Before, class After>
Lane energy_of_inerters(const InerterChain& chain, const Inertances& c, const Lane& mass_per_size,
                        const X& x, const Before& before, const After& after) {
  Lane total{};
  for (int l = 0; l < chain.links; ++l)
    total += kernels::inerter_energy<Lane>(
        difference<D>(l, chain.links, x), difference<D>(l, chain.links, before),
        difference<D>(l, chain.links, after), mass_per_size * entry(chain.reduced, l),
        c(entry(chain.nodes, l)));
  return total;
}

}  // namespace pulvis
