// commit_plasticity: the plastic strains of an equilibrium become the initial state of the next increment.
//
// Source   systems/lever/solid_plastic_kernel.hpp
// Runs     after an increment has found its equilibrium, never within an iteration
// Active   when a material of the solid has a yield stress
#include "systems/lever/solid_response.hpp"

namespace pulvis {

void commit_plasticity::operator()(Chunk chunk) const {
  const SolidReader reader{*mesh, configuration, elastic};
  for_elements(chunk, *mesh, [&](Row<SolidElement> row) {
    if (!(plasticity.yield(row, 0) > 0)) return;
    kernels::HexMemory after;
    reader.plastic(row, plasticity, false, &after);
    for (int g = 0; g < 8; ++g) {
      const auto& point = entry(after, g);
      for (int k = 0; k < 6; ++k) plasticity.memory(row, 7 * g + k) = point.strain[k];
      plasticity.memory(row, 7 * g + 6) = point.accumulated;
    }
  });
}

}  // namespace pulvis
