// How the element systems access an element of a chunk: its modes and state. No physics.
#pragma once

#include "components/bundles.hpp"
#include "engine/access.hpp"
#include "engine/entry.hpp"
#include "systems/space/body/hourglass_kernel.hpp"
#include "systems/space/body/j2_kernel.hpp"

namespace pulvis::space {

using Hexahedron = std::array<Row<Node>, 8>;

// The type of a view of lanes or of packets.
template <class View, class Entity>
using NumberOf = std::remove_cvref_t<decltype(std::declval<View>()(Row<Entity>(0)))>;

template <class Nodes>
auto element_modes(const Nodes& x, const Hexahedron& h) {
  using T = NumberOf<Nodes, Node>;
  const auto of = [&](int k) {
    return kernels::modes_of<T>([&](int i) { return x(entry(h, i), k); });
  };
  return kernels::ElementModes<T>{of(0), of(1), of(2)};
}

template <class View>
kernels::Symmetric3<NumberOf<View, Element>> cp_inverse_at(const View& c, Row<Element> e, int g) {
  const int k = 6 * g;
  return {c(e, k), c(e, k + 1), c(e, k + 2), c(e, k + 3), c(e, k + 4), c(e, k + 5)};
}
template <class View>
void store(const View& c, Row<Element> e, int g,
           const kernels::Symmetric3<NumberOf<View, Element>>& value) {
  const int k = 6 * g;
  c(e, k) = value.xx;
  c(e, k + 1) = value.yy;
  c(e, k + 2) = value.zz;
  c(e, k + 3) = value.xy;
  c(e, k + 4) = value.yz;
  c(e, k + 5) = value.zx;
}

template <class View>
kernels::Deviator<NumberOf<View, Element>> deviator_at(const View& s, Row<Element> e, int g) {
  const int k = 5 * g;
  return {s(e, k), s(e, k + 1), s(e, k + 2), s(e, k + 3), s(e, k + 4)};
}
template <class View>
void store(const View& s, Row<Element> e, int g,
           const kernels::Deviator<NumberOf<View, Element>>& value) {
  const int k = 5 * g;
  s(e, k) = value.xx;
  s(e, k + 1) = value.yy;
  s(e, k + 2) = value.xy;
  s(e, k + 3) = value.yz;
  s(e, k + 4) = value.zx;
}

template <class View>
kernels::Hourglass<NumberOf<View, Element>> hourglass_at(const View& p, Row<Element> e) {
  return {{p(e, 0), p(e, 1), p(e, 2)},
          {p(e, 3), p(e, 4), p(e, 5)},
          {p(e, 6), p(e, 7), p(e, 8)},
          {p(e, 9), p(e, 10), p(e, 11)}};
}
template <class View>
void store(const View& p, Row<Element> e,
           const kernels::Hourglass<NumberOf<View, Element>>& value) {
  const auto plate = [&](int k, const auto& of) {
    p(e, k) = of.sum;
    p(e, k + 1) = of.difference;
    p(e, k + 2) = of.shear;
  };
  plate(0, value.plate1);
  plate(3, value.plate2);
  plate(6, value.plate3);
  p(e, 9) = value.last.x;
  p(e, 10) = value.last.y;
  p(e, 11) = value.last.z;
}

}  // namespace pulvis::space
