// Blocks of candidates, processed in parallel: which candidates form a block, and add to its sums, does
// not depend on the threads.
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

// A phase defines the work: active(row), fetch(row) (which prefetches what the row needs), (row, Sums of
// its block), and keep(block, Sums).
template <class At, class Phase>
void for_active_rows(const RowBlocks<At>& rows, const Phase& phase) {
  constexpr std::size_t rows_ahead = 3;
  Deal tasks(rows.count(), tbb::this_task_arena::max_concurrency());
  for_pieces(tasks, [&](int block) {
    std::array<std::int32_t, RowBlocks<At>::most> active;
    std::size_t count = 0;
    for (int r = entry(rows.begin, block); r < entry(rows.begin, block + 1); ++r) {
      active[count] = r;
      count += phase.active(Row<At>(r)) ? 1 : 0;
    }
    typename Phase::Sums of_block;
    for (std::size_t i = 0; i < std::min(rows_ahead, count); ++i) phase.fetch(Row<At>(active[i]));
    for (std::size_t i = 0; i < count; ++i) {
      if (i + rows_ahead < count) phase.fetch(Row<At>(active[i + rows_ahead]));
      phase(Row<At>(active[i]), of_block);
    }
    phase.keep(block, of_block);
  });
}

}  // namespace pulvis::space
