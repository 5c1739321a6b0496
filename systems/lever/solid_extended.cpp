// factorise_extended: stiffness and factors of the solid in long double, from the elements on.
//
// Source   as solid_element, block_tangent and factorise, whose numbers in double have lost the bending of a
//          lever some 5,000 times longer than thick, or a billion times softer than its tip. A matrix made
//          in double cannot be mended: it must have its digits from the kernels.
// Runs     after residual, in place of block_tangent and factorise
// Active   when the answers of a lever at rest did not converge in double (AfmSimulation)
#include <oneapi/tbb/parallel_for.h>

#include "systems/lever/solid_response.hpp"
#include "systems/lever/solid_systems.hpp"

namespace pulvis {
namespace {

using Wide = long double;

// [elements] lower triangles, row by row
struct WideTangents {
  static constexpr std::size_t of_hexahedron = 300, of_tetrahedron = 465;
  std::vector<Wide> hexahedra, tetrahedra;

  Wide at(const SolidAssembly::Share& share, int i, int j) const {
    const int r = 3 * share.row + i, c = 3 * share.column + j;
    const auto place = static_cast<std::size_t>(r >= c ? r * (r + 1) / 2 + c : c * (c + 1) / 2 + r);
    const auto element = static_cast<std::size_t>(share.element);
    return share.tetrahedron ? tetrahedra[of_tetrahedron * element + place]
                             : hexahedra[of_hexahedron * element + place];
  }
};

template <class Matrix>
void pack(const Matrix& tangent, Wide* to) {
  for (int i = 0; i < tangent.rows(); ++i)
    for (int j = 0; j <= i; ++j) *to++ = tangent(i, j);
}

// Where an element flows, its tangent is the plastic one, in double.
void wide_tangent(const SolidReader& reader, Row<SolidElement> row,
                  const Optional<Read<SolidYield>>& yield,
                  const Optional<Read<SolidMemory>>& memory, Wide* to) {
  if (yield && (*yield)(row, 0) > 0) {
    kernels::HexMemory after;
    const auto r = reader.plastic(row, *yield, *memory, true, &after);
    const auto flowed = [](const kernels::PlasticMemory& m) { return m.accumulated > 0; };
    if (std::ranges::any_of(after, flowed)) return pack(r.tangent, to);
  }
  pack(reader.elastic_tangent<Wide>(row), to);
}

}  // namespace

void factorise_extended(Read<SolidAssembly> assembly, Read<SolidMesh> mesh,
                        Read<ReferencePosition> reference, Read<Displacement> displacement,
                        Read<LameConstants> elastic, Optional<Read<TetrahedronLame>> tetrahedron,
                        Optional<Read<SolidYield>> yield, Optional<Read<FlowLaws>> laws,
                        Optional<Read<SolidMemory>> memory, Write<SolidEquations> equations) {
  const SolidReader reader{*mesh, reference, displacement, elastic, laws_of(laws)};
  WideTangents tangents;
  tangents.hexahedra.resize(WideTangents::of_hexahedron * mesh->hexahedra.size());
  tangents.tetrahedra.resize(WideTangents::of_tetrahedron * mesh->tetrahedra.size());
  tbb::parallel_for(std::size_t{0}, mesh->hexahedra.size(), [&](std::size_t e) {
    wide_tangent(reader, Row<SolidElement>(static_cast<int>(e)), yield, memory,
                 &tangents.hexahedra[WideTangents::of_hexahedron * e]);
  });
  tbb::parallel_for(std::size_t{0}, mesh->tetrahedra.size(), [&](std::size_t e) {
    const Row<SolidTetrahedron> row(static_cast<int>(e));
    const auto r =
        kernels::TetrahedronKernel<Wide>::response(nodes_of(*mesh, row, reference).cast<Wide>(),
                                                   nodes_of(*mesh, row, displacement).cast<Wide>(),
                                                   (*tetrahedron)(row, 0), (*tetrahedron)(row, 1));
    pack(r.tangent, &tangents.tetrahedra[WideTangents::of_tetrahedron * e]);
  });
  std::vector<Wide> blocks(9 * assembly->block_row.size());
  tbb::parallel_for(std::size_t{0}, assembly->block_row.size(), [&](std::size_t b) {
    const auto first = static_cast<std::size_t>(assembly->block_begin[b]);
    const auto last = static_cast<std::size_t>(assembly->block_begin[b + 1]);
    for (std::size_t s = first; s < last; ++s)
      for (int i = 0; i < 9; ++i)
        blocks[9 * b + static_cast<std::size_t>(i)] +=
            assembly->shares[s].weight * tangents.at(assembly->shares[s], i / 3, i % 3);
  });
  equations->answers.clear();
  equations->extended.factorise(*assembly, std::span<const Wide>(blocks));
}

}  // namespace pulvis
