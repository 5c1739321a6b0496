// cell_load: for each particle, its centre of mass, the sum of the contact forces on it, and how much its contacts resist
// a strain of the cell.
//
// Resistance  a strain E of the cell moves the particles of a contact apart by E l, with l from centre to centre. Its
//             springs K and dashpots C thus add K l^2 and C l^2. Both particles sample a contact, and
//             l^2 <= (r + r')^2 <= 2 r^2 + 2 r'^2 with the radii about the centres: each side counts (2 r)^2.
// Runs        after contact_force; the resistance only with the stable time step, which guards the same springs
#include <algorithm>

#include "engine/chunk_lane.hpp"
#include "engine/entry.hpp"
#include "systems/cell/systems.hpp"
#include "systems/tools/servo_touch.hpp"

namespace pulvis {
namespace {

// Springs and dashpots of what a particle samples.
kernels::TouchSums touching_at(const cell_load::Contacts& contacts, int slot) {
  kernels::TouchSums sums;
  for (const Row<Contact> row : contacts.index->sampled_by(slot)) {
    if (contacts.rows.touches(row) == 0) continue;
    const kernels::TouchSums of_row =
        touching_of(row, contacts.rows, contacts.law, contacts.rules->stiffest_weld());
    sums.stiffness += of_row.stiffness;
    sums.damping += of_row.damping;
  }
  return sums;
}

}  // namespace

[[gnu::flatten]] void cell_load::operator()(Chunk chunk) const {
  const Row<Particle> particle;
  const Shape& shape = bodies->shape_of_chunk(chunk);
  const auto x = position.chunk(chunk);
  const auto f = force.chunk(chunk);
  double area = 0;
  Lane mx{}, my{};
  for (int i = 0; i < static_cast<int>(shape.nodes.size()); ++i) {
    area += entry(shape.nodal_area, i);
    mx += entry(shape.nodal_area, i) * x(Row<Node>(i), 0);
    my += entry(shape.nodal_area, i) * x(Row<Node>(i), 1);
  }
  const Lane cx = (1 / area) * mx, cy = (1 / area) * my;
  Lane fx{}, fy{}, square{};
  for (int i = 0; i < shape.boundary_nodes; ++i) {
    fx += f(Row<BoundaryNode>(i), 0);
    fy += f(Row<BoundaryNode>(i), 1);
    const Lane rx = x(Row<Node>(i), 0) - cx, ry = x(Row<Node>(i), 1) - cy;
    square = max(square, rx * rx + ry * ry);
  }
  const auto centre = load.centre.chunk(chunk);
  const auto net = load.force.chunk(chunk);
  centre(particle, 0) = cx, centre(particle, 1) = cy;
  net(particle, 0) = fx, net(particle, 1) = fy;
  if (clock->step < clock->next_look) return;
  const auto resistance = load.resistance.chunk(chunk);
  for (int lane = 0; lane < lane_count; ++lane) {
    const kernels::TouchSums sums = touching_at(contacts, ChunkLane(chunk, lane).slot());
    resistance(particle, 0)[lane] = 4 * square[lane] * sums.stiffness;
    resistance(particle, 1)[lane] = 4 * square[lane] * sums.damping;
  }
}

}  // namespace pulvis
