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
#include "systems/space/contact/assembly.hpp"
#include "systems/tools/servo_touch.hpp"

namespace pulvis {
namespace {

using kernels::TouchSums;

// Springs and dashpots of what a particle samples.
TouchSums touching_at(const cell_load<TwoD>& s, int slot) {
  TouchSums sums;
  const auto& [index, rules, pairs, law] = s.contacts;
  for (const Row<Contact> row : index->sampled_by(slot))
    if (pairs.rows.touches(row) != 0)
      sums.include(touching_of(s.bodies, row, pairs.rows, law, rules->stiffest_weld()));
  return sums;
}
TouchSums touching_at(const cell_load<ThreeD>& s, int slot) {
  TouchSums sums;
  const auto& [index, rules, pairs, law] = s.contacts;
  const auto& rows = pairs.rows;
  const double bonds = rules->stiffest_weld();
  const std::int32_t end = entry(index->sampled_begin, slot + 1);
  for (int p = rows.of->from_row(entry(index->sampled_begin, slot)); entry(rows.of->begin, p) < end;
       ++p)
    space::for_touching_points(rows, p, [&](Row<FaceContact> row, int g, const auto& force) {
      const auto& face = entry(s.bodies.shape_of(slot).faces, rows.pair(row, 1));
      sums.include(touching_at_point(row, law, force, entry(face.weight, g), bonds));
    });
  return sums;
}

}  // namespace

template <class D>
[[gnu::flatten]] void cell_load<D>::operator()(Chunk chunk) const {
  const Row<Particle> particle;
  const auto& shape = bodies.shape_of(chunk);
  const auto x = position.chunk(chunk);
  const auto f = force.chunk(chunk);
  double size = 0;
  std::array<Lane, D::axes> moment{}, net{};
  for (int i = 0; i < static_cast<int>(shape.nodes.size()); ++i) {
    const double of_node = shape.size_of_node(i);
    size += of_node;
    for (int k = 0; k < D::axes; ++k) entry(moment, k) += of_node * x(Row<Node>(i), k);
  }
  const auto centre = load.centre.chunk(chunk);
  for (int k = 0; k < D::axes; ++k) centre(particle, k) = (1 / size) * entry(moment, k);
  Lane square{};
  for (int i = 0; i < shape.boundary_nodes; ++i) {
    Lane of_node{};
    for (int k = 0; k < D::axes; ++k) {
      entry(net, k) += f(Row<BoundaryNode>(i), k);
      const Lane arm = x(Row<Node>(i), k) - centre(particle, k);
      of_node += arm * arm;
    }
    square = max(square, of_node);
  }
  const auto sum = load.force.chunk(chunk);
  for (int k = 0; k < D::axes; ++k) sum(particle, k) = entry(net, k);
  if (clock->step < clock->next_look) return;
  const auto resistance = load.resistance.chunk(chunk);
  for (int lane = 0; lane < lane_count; ++lane) {
    const TouchSums sums = touching_at(*this, ChunkLane(chunk, lane).slot());
    resistance(particle, 0)[lane] = 4 * square[lane] * sums.stiffness;
    resistance(particle, 1)[lane] = 4 * square[lane] * sums.damping;
  }
}
template struct cell_load<TwoD>;
template struct cell_load<ThreeD>;

}  // namespace pulvis
