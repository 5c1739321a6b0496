// How the element systems access an element of a chunk: its map, points and state. No physics.
#pragma once

#include "components/shape.hpp"
#include "engine/access.hpp"
#include "engine/entry.hpp"
#include "systems/body/j2_kernel.hpp"

namespace pulvis {

using Quad = std::array<Row<Node>, 4>;
template <int Points>
using ElementPoints = std::array<Shape::GaussPoint, static_cast<std::size_t>(Points)>;

template <int Points>
const ElementPoints<Points>& points_of(const Shape& shape, int element) {
  if constexpr (Points == 1)
    return entry(shape.centre, element);
  else
    return entry(shape.gauss, element);
}

// One-point elements use the fourfold map.
template <int Points, class Nodes>
auto quad_map(const Nodes& x, const Quad& q) {
  const auto of_corners = [&](auto map) {
    return map(x(q[0], 0), x(q[0], 1), x(q[1], 0), x(q[1], 1), x(q[2], 0), x(q[2], 1), x(q[3], 0),
               x(q[3], 1));
  };
  using T = std::remove_cvref_t<decltype(x(q[0]))>;
  if constexpr (Points == 1)
    return of_corners(kernels::fourfold_map<T>);
  else
    return of_corners(kernels::quad_map<T>);
}

// At point g of an element with `Points` Gauss points.
template <int Points, class T, int Scale>
kernels::Matrix2<T> map_gradient(const kernels::QuadMap<T, Scale>& map, int g) {
  if constexpr (Points == 1)
    return {map.ax, map.bx, map.ay, map.by};
  else
    return kernels::map_gradient(map, kernels::gauss_xi[g], kernels::gauss_eta[g]);
}

// theta: current over undeformed area of the element.
template <class T>
T mean_dilatation(const kernels::QuadMap<T>& map, const ElementPoints<4>& points) {
  T now{};
  double before = 0;
  for (int g = 0; g < 4; ++g) {
    now += determinant(map_gradient<4>(map, g));
    before += entry(points, g).determinant;
  }
  return now * (1 / before);
}
// A quad's area is that of the parallelogram at its centre: 1/4 det of the fourfold map.
template <class T>
T mean_dilatation(const kernels::FourfoldMap<T>& map, const ElementPoints<1>& points) {
  return determinant(map_gradient<1>(map, 0)) * (0.25 / points[0].determinant);
}

// The number type of a view of lanes or of packets.
template <class View>
using NumberOf = std::remove_cvref_t<decltype(std::declval<View>()(Row<Element>(0)))>;

template <class View>
kernels::Symmetric3<NumberOf<View>> cp_inverse_at(const View& c, Row<Element> e, int g) {
  return {c(e, 4 * g), c(e, 4 * g + 1), c(e, 4 * g + 2), c(e, 4 * g + 3)};
}

template <class View>
kernels::Deviator<NumberOf<View>> deviator(const View& s, Row<Element> e, int g) {
  return {s(e, 3 * g), s(e, 3 * g + 1), s(e, 3 * g + 2)};
}

template <class View>
void store(const View& s, Row<Element> e, int g, const kernels::Deviator<NumberOf<View>>& value) {
  s(e, 3 * g) = value.xx;
  s(e, 3 * g + 1) = value.yy;
  s(e, 3 * g + 2) = value.xy;
}

}  // namespace pulvis
