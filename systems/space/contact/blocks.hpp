// Blocks of candidates, one after the other on all threads: which candidates make a block, in which they are booked, does
// not depend on threads.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "components/contact.hpp"
#include "engine/deal.hpp"
#include "engine/entry.hpp"
#include "systems/space/contact/contact_law.hpp"

namespace pulvis::space {

inline constexpr int candidates_of_a_block = 32;

// A phase says what is done: active(row), fetch(row) (which asks for what it needs before it is needed), and (row, sums of
// its block).
template <class At, class Phase>
void for_active_rows(int rows, std::vector<BlockSums>& sums, const Phase& phase) {
  constexpr std::size_t rows_ahead = 3;
  const int blocks = (rows + candidates_of_a_block - 1) / candidates_of_a_block;
  sums.resize(static_cast<std::size_t>(blocks));
  Deal tasks(blocks, tbb::this_task_arena::max_concurrency());
  for_pieces(tasks, [&](int block) {
    std::array<std::int32_t, candidates_of_a_block> active;
    std::size_t count = 0;
    const int first = block * candidates_of_a_block;
    for (int r = first; r < std::min(rows, first + candidates_of_a_block); ++r) {
      active[count] = r;
      count += phase.active(Row<At>(r)) ? 1 : 0;
    }
    FaceSums of_block;
    for (std::size_t i = 0; i < std::min(rows_ahead, count); ++i) phase.fetch(Row<At>(active[i]));
    for (std::size_t i = 0; i < count; ++i) {
      if (i + rows_ahead < count) phase.fetch(Row<At>(active[i + rows_ahead]));
      phase(Row<At>(active[i]), of_block);
    }
    entry(sums, block) = of_block.added_up();
  });
}

}  // namespace pulvis::space
