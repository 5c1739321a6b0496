// Blocks of candidates, one after the other on all threads: which candidates make a block, in which they are booked, does
// not depend on threads.
#pragma once

#include <algorithm>
#include <vector>

#include "components/contact.hpp"
#include "engine/deal.hpp"
#include "engine/entry.hpp"
#include "systems/space/contact/contact_law.hpp"

namespace pulvis::space {

inline constexpr int candidates_of_a_block = 32;

// look_at(row, sums of its block), for rows where active(row).
template <class At, class Active, class LookAt>
void for_active_rows(int rows, std::vector<BlockSums>& sums, const Active& active,
                     const LookAt& look_at) {
  const int blocks = (rows + candidates_of_a_block - 1) / candidates_of_a_block;
  sums.resize(static_cast<std::size_t>(blocks));
  Deal tasks(blocks, tbb::this_task_arena::max_concurrency());
  for_pieces(tasks, [&](int block) {
    FaceSums of_block;
    const int last = std::min(rows, (block + 1) * candidates_of_a_block);
    for (int r = block * candidates_of_a_block; r < last; ++r)
      if (active(Row<At>(r))) look_at(Row<At>(r), of_block);
    entry(sums, block) = of_block.added_up();
  });
}

}  // namespace pulvis::space
