// cell_kick: when the cell changes its velocity, each particle receives its share of the new homogeneous velocity field: it
// translates with its centre and rotates with the spin. The powder deforms as a whole, no wave enters from the boundaries,
// and particles are strained only by their contacts.
//
//   dv = C (x_c - x_0) + (C - C^T)/2 (x - x_c),   C = (change of h') h^-1
//   work = sum m (v_n . dv + dv . dv/2),   v_n = v_(n-1/2) + a_n (dt_before + dt)/4
//
// So an image moves as its particle would if it were stored there: where the cell is cut open does not matter. v_n is the
// velocity used for the kinetic energy of the leapfrog (systems/body/energies.cpp).
//
// Runs     after cell_control, before integrate
#include "engine/entry.hpp"
#include "systems/cell/systems.hpp"

namespace pulvis {
namespace {

template <class D>
using LaneVector = std::array<Lane, D::axes>;

template <class D>
[[gnu::always_inline]] inline LaneVector<D> times(const Tensor<D>& t, const LaneVector<D>& v) {
  LaneVector<D> product;
  for (std::size_t i = 0; i < D::axes; ++i) {
    product[i] = t(i, 0) * v[0];
    for (std::size_t j = 1; j < D::axes; ++j) product[i] += t(i, j) * v[j];
  }
  return product;
}

template <class D, class Column>
[[gnu::always_inline]] inline LaneVector<D> vector_at(const Column& column, auto row) {
  LaneVector<D> v;
  for (int k = 0; k < D::axes; ++k) entry(v, k) = column(row, k);
  return v;
}

}  // namespace

template <class D>
[[gnu::flatten]] void cell_kick<D>::operator()(Chunk chunk) const {
  const auto total = work.chunk(chunk);
  Lane sum{};
  const Tensor<D>& change = cell->change;
  if (change.t != Tensor<D>{}.t) {
    const auto& shape = bodies.shape_of(chunk);
    const auto x = place.position.chunk(chunk);
    const auto v = velocity.chunk(chunk);
    const auto internal = forces.internal.chunk(chunk);
    const auto contact = forces.contact->chunk(chunk);
    const Lane mass_per_size = density.chunk(chunk)(Row<Particle>()) * bodies.depth();
    const double quarter = 0.25 * (clock->dt_before + clock->dt);
    const LaneVector<D> centre = vector_at<D>(place.centre.chunk(chunk), Row<Particle>());
    LaneVector<D> from_middle;
    for (std::size_t k = 0; k < D::axes; ++k) from_middle[k] = centre[k] - cell->centre[k];
    const LaneVector<D> common = times(change, from_middle);
    const Tensor<D> spin = 0.5 * (change + -1.0 * change.transposed());
    for (int i = 0; i < static_cast<int>(shape.nodes.size()); ++i) {
      const Row<Node> n(i);
      LaneVector<D> arm = vector_at<D>(x, n), force = vector_at<D>(internal, n);
      for (std::size_t k = 0; k < D::axes; ++k) arm[k] -= centre[k];
      if (i < shape.boundary_nodes)
        for (int k = 0; k < D::axes; ++k) entry(force, k) += contact(Row<BoundaryNode>(i), k);
      const LaneVector<D> turned = times(spin, arm);
      const Lane mass = mass_per_size * shape.size_of_node(i);
      for (int k = 0; k < D::axes; ++k) {
        const Lane dv = entry(common, k) + entry(turned, k);
        sum += dv * (mass * (v(n, k) + 0.5 * dv) + quarter * entry(force, k));
        v(n, k) += dv;
      }
    }
  }
  total(Row<Particle>()) = sum;
}
template struct cell_kick<TwoD>;
template struct cell_kick<ThreeD>;

}  // namespace pulvis
