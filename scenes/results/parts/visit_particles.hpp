// The particles of a world by number.
#pragma once

#include "components/dimension.hpp"
#include "components/shape.hpp"
#include "components/space/shape.hpp"
#include "engine/world.hpp"

namespace pulvis {

template <class D>
const typename D::Shape& shape_in_slot(const World& world, int slot) {
  const Bodies& bodies = world.resource<Bodies>();
  if constexpr (D::axes == 2)
    return bodies.shape_of_slot(slot);
  else
    return entry(world.resource<space::Shapes>().list, entry(bodies.slots, slot).shape);
}

// Calls visit(offset of its rows of nodes, lane, shape) for every particle.
template <class D, class Visit>
void visit_particles(const World& world, const Visit& visit) {
  const Table& table = const_cast<World&>(world).table<Node>();
  for (const int slot : world.resource<Bodies>().slot_of_number)
    visit(static_cast<std::size_t>(table.chunk_begin[static_cast<std::size_t>(slot / lane_count)]),
          slot % lane_count, shape_in_slot<D>(world, slot));
}

// Values of all nodes in column C, particle by particle.
template <class D, class C>
std::vector<double> node_values(const World& world) {
  std::vector<double> all;
  visit_particles<D>(world, [&](std::size_t first, int lane, const auto& shape) {
    const Lane* at = world.column<C>().lanes() + first * C::count;
    for (std::size_t i = 0; i < shape.nodes.size() * C::count; ++i) all.push_back(at[i][lane]);
  });
  return all;
}

}  // namespace pulvis
