// Sums over all rows of a place, by several threads: of blocks of rows that do not depend on their number, added
// up in order, so that the bits do not either.
#pragma once

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <vector>

namespace pulvis {

inline constexpr int rows_of_a_block = 2048;

// add(row, sum) adds a row's share; `Sum` has +=.
template <class Sum, class Add>
Sum sum_over_rows(int rows, const Add& add) {
  const int blocks = (rows + rows_of_a_block - 1) / rows_of_a_block;
  std::vector<Sum> parts(static_cast<std::size_t>(blocks));
  tbb::parallel_for(0, blocks, [&](int block) {
    Sum part{};
    const int last = std::min((block + 1) * rows_of_a_block, rows);
    for (int row = block * rows_of_a_block; row < last; ++row) add(row, part);
    parts[static_cast<std::size_t>(block)] = part;
  });
  Sum sum{};
  for (const Sum& part : parts) sum += part;
  return sum;
}

}  // namespace pulvis
