// One element's response from the columns of the solid: shared by solid_element, element_force,
// commit_plasticity, the systems of the tetrahedra and factorise_extended.
#pragma once

#include "engine/entry.hpp"
#include "systems/lever/solid_plastic_kernel.hpp"
#include "systems/lever/solid_systems.hpp"
#include "systems/lever/solid_tetrahedron_kernel.hpp"

namespace pulvis {

// Calls `each(row)` for the elements of a chunk.
template <class Each>
void for_elements(Chunk chunk, const SolidMesh& mesh, const Each& each) {
  const auto& begin = mesh.chunk_begin;
  for (int e = entry(begin, chunk.index); e < entry(begin, chunk.index + 1); ++e)
    each(Row<SolidElement>(e));
}

struct SolidReader {
  const SolidMesh& mesh;
  const Configuration& configuration;
  const Read<LameConstants>& lame;

  kernels::HexResponse elastic(Row<SolidElement> row, bool with_tangent) const {
    return kernels::hex_response(reference(row), displacement(row), lame(row, 0), lame(row, 1),
                                 formulation(row), with_tangent);
  }

  template <class Real>
  typename kernels::HexKernel<Real>::NodalMatrix elastic_tangent(Row<SolidElement> row) const {
    return kernels::HexKernel<Real>::response(reference(row).template cast<Real>(),
                                              displacement(row).template cast<Real>(), lame(row, 0),
                                              lame(row, 1), formulation(row))
        .tangent;
  }

  template <template <class> class Mode>
  kernels::HexResponse plastic(Row<SolidElement> row, const SolidPlasticity<Mode>& plasticity,
                               bool with_tangent, kernels::HexMemory* after = nullptr) const {
    const auto& yield = plasticity.yield;
    const kernels::PlasticMaterial material{
        lame(row, 0), lame(row, 1), {yield(row, 0), yield(row, 1)}, curve(row, plasticity.laws)};
    return kernels::plastic_response(reference(row), displacement(row), material, formulation(row),
                                     committed(row, plasticity.memory), with_tangent, after);
  }

 private:
  const kernels::HardeningLaw* curve(Row<SolidElement> row,
                                     const Optional<Read<FlowLaws>>& laws) const {
    if (!laws) return nullptr;
    const FlowLaw& law = entry((*laws)->of_material, entry(mesh.part, row));
    return law.is_linear() ? nullptr : &law.hardening;
  }

  HexFormulation formulation(Row<SolidElement> row) const { return entry(mesh.formulation, row); }

  kernels::Corners reference(Row<SolidElement> row) const {
    return corners(row, configuration.reference);
  }
  kernels::Corners displacement(Row<SolidElement> row) const {
    return corners(row, configuration.displacement);
  }

  template <class Access>
  kernels::Corners corners(Row<SolidElement> row, const Access& values) const {
    const auto& hexahedron = entry(mesh.hexahedra, row);
    kernels::Corners x;
    for (int a = 0; a < 8; ++a)
      for (int k = 0; k < 3; ++k) x(k, a) = values(Row<SolidNode>(entry(hexahedron, a)), k);
    return x;
  }

  template <class Memory>
  static kernels::HexMemory committed(Row<SolidElement> row, const Memory& memory) {
    kernels::HexMemory m;
    for (int g = 0; g < 8; ++g) {
      auto& point = entry(m, g);
      for (int k = 0; k < 6; ++k) point.strain[k] = memory(row, 7 * g + k);
      point.accumulated = memory(row, 7 * g + 6);
    }
    return m;
  }
};

template <class Access>
kernels::TetrahedronNodes nodes_of(const SolidMesh& mesh, Row<SolidTetrahedron> row,
                                   const Access& values) {
  const auto& tetrahedron = entry(mesh.tetrahedra, row);
  kernels::TetrahedronNodes x;
  for (int a = 0; a < 10; ++a)
    for (int k = 0; k < 3; ++k) x(k, a) = values(Row<SolidNode>(entry(tetrahedron, a)), k);
  return x;
}

}  // namespace pulvis
