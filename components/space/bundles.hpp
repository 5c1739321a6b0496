// Columns that always go together in three dimensions, as bundles of accesses (engine/bundle.hpp). Mode: Read or Write.
#pragma once

#include "components/bundles.hpp"
#include "components/space/body.hpp"
#include "components/space/shape.hpp"

namespace pulvis::space {

// Location of each particle, and the mesh that all particles of a chunk share.
struct Meshes {
  Read<Bodies> bodies;
  Read<Shapes> shapes;

  const Shape& of_slot(int slot) const {
    return entry(shapes->list, entry(bodies->slots, slot).shape);
  }
  const Shape& of_chunk(Chunk chunk) const { return of_slot(ChunkLane(chunk, 0).slot()); }
};
struct Motion {  // of the nodes
  Read<Position> position;
  Read<Velocity> velocity;
};
// Nodal forces. Contact forces are kept separately, and exist only if the scene has contact.
template <template <class> class Mode>
struct NodalForces {
  Mode<InternalForce> internal;
  Optional<Read<ContactForce>> contact;
};
// F: the formulation of the elements (components/space/formulation.hpp).
template <template <class> class Mode, class F>
struct ElementStress {
  Mode<DeviatoricStress<F::points>> deviator;
  Mode<MeanStress> mean;
};

}  // namespace pulvis::space
