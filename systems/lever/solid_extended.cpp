// factorise_extended: stiffness and factors of the solid in long double, starting from the elements.
//
// Source   like solid_element, block_tangent and factorise, whose double values have lost the bending of a
//          lever some 5,000 times longer than thick, or a billion times softer than its tip. A matrix built
//          in double cannot be repaired: it must get its digits from the kernels.
// Runs     after residual, in place of block_tangent and factorise
// Active   when the solutions for a lever at rest did not converge in double (AfmSimulation)
#include <oneapi/tbb/parallel_for.h>

#include "systems/lever/solid_response.hpp"

namespace pulvis {
namespace {

using Wide = long double;

// The lower triangles of all elements, row by row.
struct WideTangents {
  static constexpr std::int64_t of_hexahedron = 300, of_tetrahedron = 465;
  std::vector<Wide> hexahedra, tetrahedra;

  explicit WideTangents(const SolidMesh& mesh)
      : hexahedra(of_hexahedron * mesh.hexahedra.size()),
        tetrahedra(of_tetrahedron * mesh.tetrahedra.size()) {}

  Wide* of(Row<SolidElement> row) { return &entry(hexahedra, of_hexahedron * row.value); }
  Wide* of(Row<SolidTetrahedron> row) { return &entry(tetrahedra, of_tetrahedron * row.value); }

  Wide at(const SolidAssembly::Share& share, int i, int j) const {
    const int r = 3 * share.row + i, c = 3 * share.column + j;
    const int place = r >= c ? r * (r + 1) / 2 + c : c * (c + 1) / 2 + r;
    return share.tetrahedron ? entry(tetrahedra, of_tetrahedron * share.element + place)
                             : entry(hexahedra, of_hexahedron * share.element + place);
  }
};

template <class Matrix>
void pack(const Matrix& tangent, Wide* to) {
  for (int i = 0; i < tangent.rows(); ++i)
    for (int j = 0; j <= i; ++j) *to++ = tangent(i, j);
}

// If an element yields, its tangent is the plastic one, in double.
void wide_tangent(const SolidReader& reader, Row<SolidElement> row,
                  const Optional<SolidPlasticity<Read>>& plasticity, Wide* to) {
  if (plasticity && plasticity->yield(row, 0) > 0) {
    kernels::HexMemory after;
    const auto r = reader.plastic(row, *plasticity, true, &after);
    const auto flowed = [](const kernels::PlasticMemory& m) { return m.accumulated > 0; };
    if (std::ranges::any_of(after, flowed)) return pack(r.tangent, to);
  }
  pack(reader.elastic_tangent<Wide>(row), to);
}

WideTangents tangents_of(const factorise_extended& system) {
  const SolidMesh& mesh = *system.mesh;
  const SolidReader reader{mesh, system.configuration, system.elastic};
  WideTangents tangents(mesh);
  tbb::parallel_for(0, static_cast<int>(mesh.hexahedra.size()), [&](int e) {
    const Row<SolidElement> row(e);
    wide_tangent(reader, row, system.plasticity, tangents.of(row));
  });
  tbb::parallel_for(0, static_cast<int>(mesh.tetrahedra.size()), [&](int e) {
    const Row<SolidTetrahedron> row(e);
    const auto& lame = *system.tetrahedron;
    const auto r = kernels::TetrahedronKernel<Wide>::response(
        nodes_of(mesh, row, system.configuration.reference).cast<Wide>(),
        nodes_of(mesh, row, system.configuration.displacement).cast<Wide>(), lame(row, 0),
        lame(row, 1));
    pack(r.tangent, tangents.of(row));
  });
  return tangents;
}

std::vector<Wide> blocks_of(const SolidAssembly& assembly, const WideTangents& tangents) {
  std::vector<Wide> blocks(9 * assembly.block_row.size());
  tbb::parallel_for(0, static_cast<int>(assembly.block_row.size()), [&](int b) {
    for (const auto& share : assembly.shares_of(b))
      for (int i = 0; i < 9; ++i)
        entry(blocks, 9 * b + i) += share.weight * tangents.at(share, i / 3, i % 3);
  });
  return blocks;
}

}  // namespace

void factorise_extended::operator()() const {
  const std::vector<Wide> blocks = blocks_of(*assembly, tangents_of(*this));
  equations->answers.clear();
  equations->extended.factorise(*assembly, std::span<const Wide>(blocks));
}

}  // namespace pulvis
