// The pattern of sparse factors L D L^T of a matrix of 3 x 3 blocks: columns of L with the same rows form supernodes, whose
// entries are stored densely (J. W. H. Liu, E. G. Ng & B. W. Peyton, SIAM Journal on Matrix Analysis and Applications 14
// (1993) 242).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace pulvis::sparse {

// Blocks of the lower triangle by columns: rows ascending, the diagonal first.
struct BlockGraph {
  std::span<const std::int32_t> column_begin;  // [columns + 1] into row
  std::span<const std::int32_t> row;

  int columns() const { return static_cast<int>(column_begin.size()) - 1; }
  std::span<const std::int32_t> rows_of(int column) const;
};

struct Supernodes {
  std::vector<std::int32_t> position;   // [blocks] place of every block in the order of elimination
  std::vector<std::int32_t> first;      // [supernodes + 1] first column, as a place
  std::vector<std::size_t> row_begin;   // [supernodes + 1] into row
  std::vector<std::int32_t> row;        // places of the rows below the supernode's own, ascending
  std::vector<std::int32_t> of_column;  // [blocks] supernode of a place

  int size() const { return static_cast<int>(first.size()) - 1; }
  int columns_of(int s) const;
  std::span<const std::int32_t> rows_of(int s) const;
};

// `position`: of every block, in an order with little fill. Refined here: parents follow their children at once.
Supernodes supernodes_of(const BlockGraph& graph, std::vector<std::int32_t> position);

}  // namespace pulvis::sparse
