// solid_element: what every hexahedron answers to its corners' displacements: forces, tangent, energy.
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

}  // namespace

void solid_element(Chunk chunk, Read<SolidMesh> mesh, Read<ReferencePosition> reference,
                   Read<Displacement> displacement, Read<LameConstants> elastic,
                   Write<ElementForce> force, Write<ElementTangent> tangent,
                   Write<ElementEnergy> energy) {
  const int begin = mesh->chunk_begin[static_cast<std::size_t>(chunk.index)];
  const int end = mesh->chunk_begin[static_cast<std::size_t>(chunk.index) + 1];
  for (int e = begin; e < end; ++e) {
    const auto& hexahedron = mesh->hexahedra[static_cast<std::size_t>(e)];
    const Row<SolidElement> row(e);
    const auto r = kernels::hex_response(corners(hexahedron, reference),
                                         corners(hexahedron, displacement), elastic(row, 0),
                                         elastic(row, 1), mesh->thin[static_cast<std::size_t>(e)]);
    energy(row) = r.energy;
    int at = 0;
    for (int i = 0; i < 24; ++i) {
      force(row, i) = r.force[i];
      for (int j = 0; j <= i; ++j) tangent(row, at++) = r.tangent(i, j);
    }
  }
}

}  // namespace pulvis
