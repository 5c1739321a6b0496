// solid_element, element_force: what every hexahedron answers to its corners' displacements: forces,
// energy, and with the first also the tangent.
//
// Source   systems/solid_kernel.hpp
// Runs     first in every evaluation of an equilibrium iteration
// Active   when the scene has a lever
#include "systems/solid_kernel.hpp"
#include "systems/solid_systems.hpp"

namespace pulvis {
namespace {

template <class Access>
kernels::Corners corners(const SolidMesh::Hexahedron& hexahedron, const Access& values) {
  kernels::Corners x;
  for (int a = 0; a < 8; ++a)
    for (int k = 0; k < 3; ++k)
      x(k, a) = values(Row<SolidNode>(hexahedron[static_cast<std::size_t>(a)]), k);
  return x;
}

// Calls `each(row, element, response)` for the elements of a chunk.
template <class Each>
void for_elements(Chunk chunk, const SolidMesh& mesh, const Read<ReferencePosition>& reference,
                  const Read<Displacement>& displacement, const Read<LameConstants>& elastic,
                  bool with_tangent, const Each& each) {
  const int begin = mesh.chunk_begin[static_cast<std::size_t>(chunk.index)];
  const int end = mesh.chunk_begin[static_cast<std::size_t>(chunk.index) + 1];
  for (int e = begin; e < end; ++e) {
    const auto at = static_cast<std::size_t>(e);
    const Row<SolidElement> row(e);
    each(row, kernels::hex_response(corners(mesh.hexahedra[at], reference),
                                    corners(mesh.hexahedra[at], displacement), elastic(row, 0),
                                    elastic(row, 1), mesh.thin[at] != 0, with_tangent));
  }
}

void store(Row<SolidElement> row, const kernels::HexResponse& r, const Write<ElementForce>& force,
           const Write<ElementEnergy>& energy) {
  energy(row) = r.energy;
  for (int i = 0; i < 24; ++i) force(row, i) = r.force[i];
}

}  // namespace

void solid_element(Chunk chunk, Read<SolidMesh> mesh, Read<ReferencePosition> reference,
                   Read<Displacement> displacement, Read<LameConstants> elastic,
                   Write<ElementForce> force, Write<ElementTangent> tangent,
                   Write<ElementEnergy> energy) {
  for_elements(chunk, *mesh, reference, displacement, elastic, true,
               [&](Row<SolidElement> row, const kernels::HexResponse& r) {
                 store(row, r, force, energy);
                 int at = 0;
                 for (int i = 0; i < 24; ++i)
                   for (int j = 0; j <= i; ++j) tangent(row, at++) = r.tangent(i, j);
               });
}

void element_force(Chunk chunk, Read<SolidMesh> mesh, Read<ReferencePosition> reference,
                   Read<Displacement> displacement, Read<LameConstants> elastic,
                   Write<ElementForce> force, Write<ElementEnergy> energy) {
  for_elements(
      chunk, *mesh, reference, displacement, elastic, false,
      [&](Row<SolidElement> row, const kernels::HexResponse& r) { store(row, r, force, energy); });
}

}  // namespace pulvis
