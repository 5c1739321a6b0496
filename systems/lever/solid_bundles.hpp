// Columns of a solid and its probe that always go together, as bundles of accesses (engine/bundle.hpp).
#pragma once

#include "components/probe.hpp"
#include "components/solid.hpp"
#include "engine/access.hpp"

namespace pulvis {

struct Configuration {  // initial positions of the solid's nodes, and their displacements
  Read<ReferencePosition> reference;
  Read<Displacement> displacement;
};
struct ElementForces {  // for all elements
  Read<ElementForce> hexahedra;
  Optional<Read<TetrahedronForce>> tetrahedra;
};
struct ElementTangents {
  Read<ElementTangent> hexahedra;
  Optional<Read<TetrahedronTangent>> tetrahedra;
};
// The points of a probe: what they are, their state at the last equilibrium, their forces.
struct Probe {
  Read<ProbeNode> node;
  Read<ProbeStiffness> stiffness;
  Read<ProbeShare> share;
  Read<ProbeMemory> memory;
  Read<ProbeForce> force;
};

}  // namespace pulvis
