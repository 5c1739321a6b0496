// Access to the pairs of nodes with an inerter (inerter_kernel.hpp).
#pragma once

#include <array>

#include "components/boundary_pairs.hpp"
#include "engine/entry.hpp"
#include "systems/body/inerter_kernel.hpp"

namespace pulvis {

// A nodal quantity of the outer node relative to the inner one.
template <class D, class Nodes>
auto difference(const BoundaryPairs::Pair& pair, const Nodes& nodes) {
  std::array<Lane, D::axes> d;
  for (int k = 0; k < D::axes; ++k) entry(d, k) = nodes(pair.outer, k) - nodes(pair.inner, k);
  return d;
}

// kg, reduced mass of a pair, over density times depth.
template <class AnyShape>
double reduced_size(const BoundaryPairs::Pair& pair, const AnyShape& shape) {
  return kernels::reduced_mass(shape.size_of_node(pair.outer.value),
                               shape.size_of_node(pair.inner.value));
}

}  // namespace pulvis
