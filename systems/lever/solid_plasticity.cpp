// commit_plasticity: the plastic strains of an equilibrium become those that the next increment starts from.
//
// Source   systems/lever/solid_plastic_kernel.hpp
// Runs     after an increment has found its equilibrium, never within an iteration
// Active   when a material of the solid has a yield stress
#include "systems/lever/solid_response.hpp"
#include "systems/lever/solid_systems.hpp"

namespace pulvis {

void commit_plasticity(Chunk chunk, Read<SolidMesh> mesh, Read<ReferencePosition> reference,
                       Read<Displacement> displacement, Read<LameConstants> elastic,
                       Read<SolidYield> yield, Optional<Read<FlowLaws>> laws,
                       Write<SolidMemory> memory) {
  const SolidReader reader{*mesh, reference, displacement, elastic, laws_of(laws)};
  for_elements(chunk, *mesh, [&](Row<SolidElement> row) {
    if (!(yield(row, 0) > 0)) return;
    kernels::HexMemory after;
    reader.plastic(row, yield, memory, false, &after);
    for (int g = 0; g < 8; ++g) {
      const auto& point = after[static_cast<std::size_t>(g)];
      for (int k = 0; k < 6; ++k) memory(row, 7 * g + k) = point.strain[k];
      memory(row, 7 * g + 6) = point.accumulated;
    }
  });
}

}  // namespace pulvis
