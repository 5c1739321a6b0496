// solid_element, element_force: what every hexahedron answers to its corners' displacements: forces,
// energy, and with the first also the tangent.
//
// Source   systems/lever/solid_kernel.hpp, systems/lever/solid_plastic_kernel.hpp (elements that yield)
// Runs     first in every evaluation of an equilibrium iteration
// Active   when the scene has a lever
#include "systems/lever/solid_response.hpp"
#include "systems/lever/solid_systems.hpp"

namespace pulvis {
namespace {

void store(Row<SolidElement> row, const kernels::HexResponse& r, const Write<ElementForce>& force,
           const Write<ElementEnergy>& energy) {
  energy(row) = r.energy;
  for (int i = 0; i < 24; ++i) force(row, i) = r.force[i];
}

kernels::HexResponse response(const SolidReader& reader, Row<SolidElement> row,
                              const Optional<Read<SolidYield>>& yield,
                              const Optional<Read<SolidMemory>>& memory, bool with_tangent) {
  if (yield && (*yield)(row, 0) > 0) return reader.plastic(row, *yield, *memory, with_tangent);
  return reader.elastic(row, with_tangent);
}

}  // namespace

void solid_element(Chunk chunk, Read<SolidMesh> mesh, Read<ReferencePosition> reference,
                   Read<Displacement> displacement, Read<LameConstants> elastic,
                   Optional<Read<SolidYield>> yield, Optional<Read<FlowLaws>> laws,
                   Optional<Read<SolidMemory>> memory, Write<ElementForce> force,
                   Write<ElementTangent> tangent, Write<ElementEnergy> energy) {
  const SolidReader reader{*mesh, reference, displacement, elastic, laws_of(laws)};
  for_elements(chunk, *mesh, [&](Row<SolidElement> row) {
    const kernels::HexResponse r = response(reader, row, yield, memory, true);
    store(row, r, force, energy);
    int at = 0;
    for (int i = 0; i < 24; ++i)
      for (int j = 0; j <= i; ++j) tangent(row, at++) = r.tangent(i, j);
  });
}

void element_force(Chunk chunk, Read<SolidMesh> mesh, Read<ReferencePosition> reference,
                   Read<Displacement> displacement, Read<LameConstants> elastic,
                   Optional<Read<SolidYield>> yield, Optional<Read<FlowLaws>> laws,
                   Optional<Read<SolidMemory>> memory, Write<ElementForce> force,
                   Write<ElementEnergy> energy) {
  const SolidReader reader{*mesh, reference, displacement, elastic, laws_of(laws)};
  for_elements(chunk, *mesh, [&](Row<SolidElement> row) {
    store(row, response(reader, row, yield, memory, false), force, energy);
  });
}

}  // namespace pulvis
