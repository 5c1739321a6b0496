// solid_element, element_force: response of every hexahedron to its corner displacements: forces,
// energy, and for the first also the tangent.
//
// Source   systems/lever/solid_kernel.hpp, systems/lever/solid_plastic_kernel.hpp (elements that yield)
// Runs     first in every evaluation of an equilibrium iteration
// Active   when the scene has a lever
#include "systems/lever/solid_response.hpp"

namespace pulvis {
namespace {

void store(Row<SolidElement> row, const kernels::HexResponse& r, const Write<ElementForce>& force,
           const Write<ElementEnergy>& energy) {
  energy(row) = r.energy;
  for (int i = 0; i < 24; ++i) force(row, i) = r.force[i];
}

kernels::HexResponse hexahedron_response(const SolidReader& reader, Row<SolidElement> row,
                                         const Optional<SolidPlasticity<Read>>& plasticity,
                                         bool with_tangent) {
  if (plasticity && plasticity->yield(row, 0) > 0)
    return reader.plastic(row, *plasticity, with_tangent);
  return reader.elastic(row, with_tangent);
}

}  // namespace

void solid_element::operator()(Chunk chunk) const {
  const SolidReader reader{*mesh, configuration, elastic};
  for_elements(chunk, *mesh, [&](Row<SolidElement> row) {
    const kernels::HexResponse r = hexahedron_response(reader, row, plasticity, true);
    store(row, r, force, energy);
    int at = 0;
    for (int i = 0; i < 24; ++i)
      for (int j = 0; j <= i; ++j) tangent(row, at++) = r.tangent(i, j);
  });
}

void element_force::operator()(Chunk chunk) const {
  const SolidReader reader{*mesh, configuration, elastic};
  for_elements(chunk, *mesh, [&](Row<SolidElement> row) {
    store(row, hexahedron_response(reader, row, plasticity, false), force, energy);
  });
}

}  // namespace pulvis
