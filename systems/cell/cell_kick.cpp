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

[[gnu::flatten]] void cell_kick::operator()(Chunk chunk) const {
  const auto total = work.chunk(chunk);
  Lane sum{};
  const auto& l = cell->change.t;
  if (l != std::array<double, 4>{}) {
    const Shape& shape = bodies->shape_of_chunk(chunk);
    const int nodes = static_cast<int>(shape.nodes.size());
    const auto x = place.position.chunk(chunk);
    const auto centre = place.centre.chunk(chunk);
    const auto v = velocity.chunk(chunk);
    const auto f = forces.internal.chunk(chunk);
    const auto g = forces.contact->chunk(chunk);
    const Lane mass_per_area = density.chunk(chunk)(Row<Particle>()) * bodies->thickness;
    const double quarter = 0.25 * (clock->dt_before + clock->dt);
    const Lane cx = centre(Row<Particle>(), 0), cy = centre(Row<Particle>(), 1);
    const Lane rx = cx - cell->centre[0], ry = cy - cell->centre[1];
    const Lane of_x = l[0] * rx + l[1] * ry, of_y = l[2] * rx + l[3] * ry;
    const double spin = 0.5 * (l[2] - l[1]);
    for (int i = 0; i < nodes; ++i) {
      const Row<Node> n(i);
      const Lane dx = of_x - spin * (x(n, 1) - cy), dy = of_y + spin * (x(n, 0) - cx);
      Lane fx = f(n, 0), fy = f(n, 1);
      if (i < shape.boundary_nodes) {
        fx += g(Row<BoundaryNode>(i), 0);
        fy += g(Row<BoundaryNode>(i), 1);
      }
      const Lane mass = mass_per_area * entry(shape.nodal_area, i);
      sum += dx * (mass * (v(n, 0) + 0.5 * dx) + quarter * fx) +
             dy * (mass * (v(n, 1) + 0.5 * dy) + quarter * fy);
      v(n, 0) += dx;
      v(n, 1) += dy;
    }
  }
  total(Row<Particle>()) = sum;
}

}  // namespace pulvis
