// solid_tetrahedron, tetrahedron_force: response of every tetrahedron to its nodal displacements: forces, energy,
// and for the first also the tangent.
//
// Source   systems/lever/solid_tetrahedron_kernel.hpp
// Runs     alongside solid_element, first in every evaluation of an equilibrium iteration
// Active   when a mesh from a file has tetrahedra
#include "systems/lever/solid_response.hpp"

namespace pulvis {
namespace {

template <class Each>
void for_tetrahedra(Chunk chunk, const SolidMesh& mesh, const Each& each) {
  const auto& begin = mesh.tetrahedron_begin;
  for (int e = entry(begin, chunk.index); e < entry(begin, chunk.index + 1); ++e)
    each(Row<SolidTetrahedron>(e));
}

// For solid_tetrahedron or tetrahedron_force: stores forces and energy, and returns everything.
template <class System>
kernels::TetrahedronResponse stored_response(const System& system, Row<SolidTetrahedron> row,
                                             bool with_tangent) {
  const auto& [reference, displacement] = system.configuration;
  auto r = kernels::tetrahedron_response(
      nodes_of(*system.mesh, row, reference), nodes_of(*system.mesh, row, displacement),
      system.elastic(row, 0), system.elastic(row, 1), with_tangent);
  system.energy(row) = r.energy;
  for (int i = 0; i < 30; ++i) system.force(row, i) = r.force[i];
  return r;
}

}  // namespace

void solid_tetrahedron::operator()(Chunk chunk) const {
  for_tetrahedra(chunk, *mesh, [&](Row<SolidTetrahedron> row) {
    const auto r = stored_response(*this, row, true);
    int at = 0;
    for (int i = 0; i < 30; ++i)
      for (int j = 0; j <= i; ++j) tangent(row, at++) = r.tangent(i, j);
  });
}

void tetrahedron_force::operator()(Chunk chunk) const {
  for_tetrahedra(chunk, *mesh,
                 [&](Row<SolidTetrahedron> row) { stored_response(*this, row, false); });
}

}  // namespace pulvis
