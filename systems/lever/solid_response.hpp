// One element's response from the columns of the solid: what solid_element, element_force,
// commit_plasticity, the tetrahedra's systems and factorise_extended share.
#pragma once

#include "components/solid.hpp"
#include "engine/access.hpp"
#include "systems/laws/flow_law.hpp"
#include "systems/lever/solid_plastic_kernel.hpp"
#include "systems/lever/solid_tetrahedron_kernel.hpp"

namespace pulvis {

// Calls `each(row)` for the elements of a chunk.
template <class Each>
void for_elements(Chunk chunk, const SolidMesh& mesh, const Each& each) {
  const auto at = static_cast<std::size_t>(chunk.index);
  for (int e = mesh.chunk_begin[at]; e < mesh.chunk_begin[at + 1]; ++e) each(Row<SolidElement>(e));
}

inline const FlowLaws* laws_of(const Optional<Read<FlowLaws>>& laws) {
  return laws ? &**laws : nullptr;
}

struct SolidReader {
  const SolidMesh& mesh;
  const Read<ReferencePosition>& reference;
  const Read<Displacement>& displacement;
  const Read<LameConstants>& lame;
  const FlowLaws* laws = nullptr;  // of the parts; null: all harden linearly

  kernels::HexResponse elastic(Row<SolidElement> row, bool with_tangent) const {
    return kernels::hex_response(corners(row, reference), corners(row, displacement), lame(row, 0),
                                 lame(row, 1), formulation(row), with_tangent);
  }

  template <class Real>
  typename kernels::HexKernel<Real>::NodalMatrix elastic_tangent(Row<SolidElement> row) const {
    return kernels::HexKernel<Real>::response(corners(row, reference).template cast<Real>(),
                                              corners(row, displacement).template cast<Real>(),
                                              lame(row, 0), lame(row, 1), formulation(row))
        .tangent;
  }

  template <class Memory>
  kernels::HexResponse plastic(Row<SolidElement> row, const Read<SolidYield>& yield,
                               const Memory& memory, bool with_tangent,
                               kernels::HexMemory* after = nullptr) const {
    const kernels::PlasticMaterial material{
        lame(row, 0), lame(row, 1), {yield(row, 0), yield(row, 1)}, curve(row)};
    return kernels::plastic_response(corners(row, reference), corners(row, displacement), material,
                                     formulation(row), remembered(row, memory), with_tangent,
                                     after);
  }

 private:
  const kernels::HardeningLaw* curve(Row<SolidElement> row) const {
    if (laws == nullptr) return nullptr;
    const auto part = mesh.part[static_cast<std::size_t>(row.value)];
    const FlowLaw& law = laws->of_material[part];
    return law.is_linear() ? nullptr : &law.hardening;
  }

  HexFormulation formulation(Row<SolidElement> row) const {
    return mesh.formulation[static_cast<std::size_t>(row.value)];
  }

  template <class Access>
  kernels::Corners corners(Row<SolidElement> row, const Access& values) const {
    const auto& hexahedron = mesh.hexahedra[static_cast<std::size_t>(row.value)];
    kernels::Corners x;
    for (int a = 0; a < 8; ++a)
      for (int k = 0; k < 3; ++k)
        x(k, a) = values(Row<SolidNode>(hexahedron[static_cast<std::size_t>(a)]), k);
    return x;
  }

  template <class Memory>
  static kernels::HexMemory remembered(Row<SolidElement> row, const Memory& memory) {
    kernels::HexMemory m;
    for (int g = 0; g < 8; ++g) {
      auto& point = m[static_cast<std::size_t>(g)];
      for (int k = 0; k < 6; ++k) point.strain[k] = memory(row, 7 * g + k);
      point.accumulated = memory(row, 7 * g + 6);
    }
    return m;
  }
};

template <class Access>
kernels::TetrahedronNodes nodes_of(const SolidMesh& mesh, Row<SolidTetrahedron> row,
                                   const Access& values) {
  const auto& tetrahedron = mesh.tetrahedra[static_cast<std::size_t>(row.value)];
  kernels::TetrahedronNodes x;
  for (int a = 0; a < 10; ++a)
    for (int k = 0; k < 3; ++k)
      x(k, a) = values(Row<SolidNode>(tetrahedron[static_cast<std::size_t>(a)]), k);
  return x;
}

}  // namespace pulvis
