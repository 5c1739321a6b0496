// The particles of a world in three dimensions, by number.
#pragma once

#include "components/shape.hpp"
#include "components/space/shape.hpp"
#include "engine/world.hpp"

namespace pulvis::space {

// Calls visit(offset of its rows of `Entity`, lane, shape) for every particle.
template <class Entity, class Visit>
void visit_particles(const World& world, const Visit& visit) {
  const Bodies& bodies = world.resource<Bodies>();
  const Shapes& shapes = world.resource<Shapes>();
  const Table& table = const_cast<World&>(world).table<Entity>();
  for (const int slot : bodies.slot_of_number)
    visit(static_cast<std::size_t>(table.chunk_begin[static_cast<std::size_t>(slot / lane_count)]),
          slot % lane_count, entry(shapes.list, entry(bodies.slots, slot).shape));
}

}  // namespace pulvis::space
