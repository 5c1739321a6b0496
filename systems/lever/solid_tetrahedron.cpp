// solid_tetrahedron, tetrahedron_force: what every tetrahedron answers to its nodes' displacements: forces, energy,
// and with the first also the tangent.
//
// Source   systems/lever/solid_tetrahedron_kernel.hpp
// Runs     beside solid_element, first in every evaluation of an equilibrium iteration
// Active   when a mesh from a file has tetrahedra
#include "systems/lever/solid_response.hpp"
#include "systems/lever/solid_systems.hpp"

namespace pulvis {
namespace {

template <class Each>
void for_tetrahedra(Chunk chunk, const SolidMesh& mesh, const Each& each) {
  const auto at = static_cast<std::size_t>(chunk.index);
  for (int e = mesh.tetrahedron_begin[at]; e < mesh.tetrahedron_begin[at + 1]; ++e)
    each(Row<SolidTetrahedron>(e));
}

kernels::TetrahedronResponse answer(const SolidMesh& mesh, Row<SolidTetrahedron> row,
                                    const Read<ReferencePosition>& reference,
                                    const Read<Displacement>& displacement,
                                    const Read<TetrahedronLame>& elastic, bool with_tangent,
                                    const Write<TetrahedronForce>& force,
                                    const Write<TetrahedronEnergy>& energy) {
  auto r = kernels::tetrahedron_response(nodes_of(mesh, row, reference),
                                         nodes_of(mesh, row, displacement), elastic(row, 0),
                                         elastic(row, 1), with_tangent);
  energy(row) = r.energy;
  for (int i = 0; i < 30; ++i) force(row, i) = r.force[i];
  return r;
}

}  // namespace

void solid_tetrahedron(Chunk chunk, Read<SolidMesh> mesh, Read<ReferencePosition> reference,
                       Read<Displacement> displacement, Read<TetrahedronLame> elastic,
                       Write<TetrahedronForce> force, Write<TetrahedronTangent> tangent,
                       Write<TetrahedronEnergy> energy) {
  for_tetrahedra(chunk, *mesh, [&](Row<SolidTetrahedron> row) {
    const auto r = answer(*mesh, row, reference, displacement, elastic, true, force, energy);
    int at = 0;
    for (int i = 0; i < 30; ++i)
      for (int j = 0; j <= i; ++j) tangent(row, at++) = r.tangent(i, j);
  });
}

void tetrahedron_force(Chunk chunk, Read<SolidMesh> mesh, Read<ReferencePosition> reference,
                       Read<Displacement> displacement, Read<TetrahedronLame> elastic,
                       Write<TetrahedronForce> force, Write<TetrahedronEnergy> energy) {
  for_tetrahedra(chunk, *mesh, [&](Row<SolidTetrahedron> row) {
    answer(*mesh, row, reference, displacement, elastic, false, force, energy);
  });
}

}  // namespace pulvis
