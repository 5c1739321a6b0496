// solid_force, block_tangent: bring the numbers of the elements together, node by node and block by block.
//
// Source   Every sum runs along a list made once (components/solid.hpp, SolidAssembly), in its order: the
//          result has the same bits with any number of threads, and nothing is scattered.
// Runs     after solid_element and solid_tetrahedron, before residual and factorise
// Active   when the scene has a lever
#include <oneapi/tbb/parallel_for.h>

#include "systems/lever/solid_systems.hpp"

namespace pulvis {
namespace {

constexpr int grain = 64;  // rows a task, some microseconds of work

template <class Body>
void for_rows(int rows, const Body& body) {
  tbb::parallel_for(tbb::blocked_range<int>(0, rows, grain), [&](const auto& range) {
    for (int row = range.begin(); row < range.end(); ++row) body(row);
  });
}

int packed(int i, int j) { return i >= j ? i * (i + 1) / 2 + j : j * (j + 1) / 2 + i; }

}  // namespace

void solid_force(Read<SolidAssembly> assembly, Read<ElementForce> element,
                 Optional<Read<TetrahedronForce>> tetrahedron, Write<SolidForce> force) {
  for_rows(force.rows(), [&](int n) {
    double sum[3] = {};
    const auto first = static_cast<std::size_t>(assembly->force_begin[static_cast<std::size_t>(n)]);
    const auto last =
        static_cast<std::size_t>(assembly->force_begin[static_cast<std::size_t>(n) + 1]);
    for (std::size_t s = first; s < last; ++s) {
      const auto& share = assembly->forces[s];
      for (int k = 0; k < 3; ++k) {
        const int at = 3 * share.row + k;
        sum[k] += share.weight * (share.tetrahedron
                                      ? (*tetrahedron)(Row<SolidTetrahedron>(share.element), at)
                                      : element(Row<SolidElement>(share.element), at));
      }
    }
    for (int k = 0; k < 3; ++k) force(Row<SolidNode>(n), k) = sum[k];
  });
}

void block_tangent(Read<SolidAssembly> assembly, Read<ElementTangent> element,
                   Optional<Read<TetrahedronTangent>> tetrahedron, Write<BlockTangent> block) {
  for_rows(block.rows(), [&](int b) {
    double sum[9] = {};
    const auto first = static_cast<std::size_t>(assembly->block_begin[static_cast<std::size_t>(b)]);
    const auto last =
        static_cast<std::size_t>(assembly->block_begin[static_cast<std::size_t>(b) + 1]);
    for (std::size_t s = first; s < last; ++s) {
      const auto& share = assembly->shares[s];
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
          const int at = packed(3 * share.row + i, 3 * share.column + j);
          sum[3 * i + j] +=
              share.weight * (share.tetrahedron
                                  ? (*tetrahedron)(Row<SolidTetrahedron>(share.element), at)
                                  : element(Row<SolidElement>(share.element), at));
        }
    }
    for (int i = 0; i < 9; ++i) block(Row<StiffnessBlock>(b), i) = sum[i];
  });
}

}  // namespace pulvis
