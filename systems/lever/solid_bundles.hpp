// Columns of a solid and of its probe that always go together, as bundles of accesses (engine/bundle.hpp).
#pragma once

#include "components/probe.hpp"
#include "components/solid.hpp"
#include "engine/access.hpp"

namespace pulvis {

struct Configuration {  // where the solid's nodes were, and how far they have moved
  Read<ReferencePosition> reference;
  Read<Displacement> displacement;
};
struct ElementForces {  // of all elements
  Read<ElementForce> hexahedra;
  Optional<Read<TetrahedronForce>> tetrahedra;
};
struct ElementTangents {
  Read<ElementTangent> hexahedra;
  Optional<Read<TetrahedronTangent>> tetrahedra;
};
// The points of a probe: what they are, what they carry from the last equilibrium, what they bear.
struct Probe {
  Read<ProbeNode> node;
  Read<ProbeStiffness> stiffness;
  Read<ProbeShare> share;
  Read<ProbeMemory> memory;
  Read<ProbeForce> force;
};

}  // namespace pulvis
