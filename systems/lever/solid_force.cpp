// solid_force, block_tangent: assemble the element contributions, node by node and block by block.
//
// Source   Every sum runs along a list built once (components/solid.hpp, SolidAssembly), in its order: the
//          result is bitwise identical for any number of threads, and nothing is scattered.
// Runs     after solid_element and solid_tetrahedron, before residual and factorise
// Active   when the scene has a lever
#include <oneapi/tbb/parallel_for.h>

#include "systems/lever/solid_systems.hpp"

namespace pulvis {
namespace {

constexpr int grain = 64;  // rows per task, some microseconds of work

template <class Body>
void for_rows(int rows, const Body& body) {
  tbb::parallel_for(tbb::blocked_range<int>(0, rows, grain), [&](const auto& range) {
    for (int row = range.begin(); row < range.end(); ++row) body(row);
  });
}

int packed(int i, int j) { return i >= j ? i * (i + 1) / 2 + j : j * (j + 1) / 2 + i; }

}  // namespace

void solid_force::operator()() const {
  for_rows(force.rows(), [&](int n) {
    double sum[3] = {};
    for (const auto& share : assembly->forces_of(n))
      for (int k = 0; k < 3; ++k) {
        const int at = 3 * share.row + k;
        sum[k] +=
            share.weight * (share.tetrahedron
                                ? (*elements.tetrahedra)(Row<SolidTetrahedron>(share.element), at)
                                : elements.hexahedra(Row<SolidElement>(share.element), at));
      }
    for (int k = 0; k < 3; ++k) force(Row<SolidNode>(n), k) = sum[k];
  });
}

void block_tangent::operator()() const {
  for_rows(block.rows(), [&](int b) {
    double sum[9] = {};
    for (const auto& share : assembly->shares_of(b))
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
          const int at = packed(3 * share.row + i, 3 * share.column + j);
          sum[3 * i + j] +=
              share.weight * (share.tetrahedron
                                  ? (*elements.tetrahedra)(Row<SolidTetrahedron>(share.element), at)
                                  : elements.hexahedra(Row<SolidElement>(share.element), at));
        }
    for (int i = 0; i < 9; ++i) block(Row<StiffnessBlock>(b), i) = sum[i];
  });
}

}  // namespace pulvis
