// Active pairs: the candidates that may touch in this step, processed two at a time by a narrow phase.
//
// Order    how candidates are paired, and which block they are summed in, does not depend on threads. Inactive ones
//          are apart and add nothing
// Memory   the candidates of a large powder come from main memory, so they are prefetched some candidates ahead; a task
//          has several blocks, so that the first of the next are prefetched while the last of one are processed
//
// A phase defines the work: active(row), fetch(row), fetch_other(row) (which may use what the first has prefetched),
// and (two, sums of their block); (two, two, sums) as well, where side by side is faster. Phase::Sums accumulates.
#pragma once

#include <algorithm>
#include <concepts>
#include <cstdint>

#include "engine/deal.hpp"
#include "engine/entry.hpp"
#include "systems/contact/contact_sums.hpp"
#include "systems/contact/two_candidates.hpp"

namespace pulvis {

// This many stay in the caches from step to step; prefetching what is there already only costs time.
inline constexpr int rows_in_cache = 16384;

// The computations of two candidates form a dependency chain, and no processor looks ahead as far as the next two:
// where one register holds all points of both, two pairs run side by side. With more registers they fill the time.
inline constexpr bool side_by_side = simd::registers == 1;

namespace detail {

inline constexpr int min_tasks = 64, max_blocks = 16;  // per task
template <class At>
inline constexpr std::size_t max_rows_of_a_task = max_blocks* (RowBlocks<At>::most + 1);

// The active candidates of a task: an even number from every block.
template <class At>
struct ActiveOfTask {
  std::array<std::int32_t, max_rows_of_a_task<At>> row;
  std::array<std::size_t, max_blocks> end;  // for each block, in row
  std::size_t count = 0;

  // Branch-free: which candidates are active follows no pattern.
  template <class Phase>
  void add_block(int block, int first, int last, const Phase& phase) {
    std::size_t n = count;
    for (int r = first; r < last; ++r) {
      row[n] = r;
      n += phase.active(Row<At>(r)) ? 1 : 0;
    }
    if (n % 2 != 0) {
      row[n] = row[n - 1];
      ++n;
    }
    entry(end, block) = count = n;
  }
};

// Processes them in order and prefetches those ahead.
template <class At, class Phase>
struct ActiveWalk {
  static constexpr std::size_t rows_before = 24, rows_before_other = 12;
  const ActiveOfTask<At>& list;
  const Phase& phase;
  bool from_memory;

  [[gnu::always_inline]] void ask(std::size_t i) const {
    if (from_memory && i < list.count) phase.fetch(Row<At>(list.row[i]));
  }
  [[gnu::always_inline]] void ask_other(std::size_t i) const {
    if (from_memory && i < list.count) phase.fetch_other(Row<At>(list.row[i]));
  }
  void begin() const {
    for (std::size_t i = 0; i < rows_before; ++i) ask(i);
    for (std::size_t i = 0; i < rows_before_other; ++i) ask_other(i);
  }
  [[gnu::always_inline]] TwoCandidates<At> two(std::size_t i) const {
    for (std::size_t k = i; k < i + 2; ++k) {
      ask(k + rows_before);
      ask_other(k + rows_before_other);
    }
    return {Row<At>(list.row[i]), Row<At>(list.row[i + 1])};
  }
  typename Phase::Sums::Block look_at(std::size_t i, std::size_t end) const {
    typename Phase::Sums sums;
    if constexpr (side_by_side && std::invocable<Phase, TwoCandidates<At>, TwoCandidates<At>,
                                                 typename Phase::Sums&>)
      for (; i + 4 <= end; i += 4) phase(two(i), two(i + 2), sums);
    for (; i < end; i += 2) phase(two(i), sums);
    return sums.added_up();
  }
};

}  // namespace detail

template <class At, class Phase>
void for_active_pairs(const RowBlocks<At>& rows, std::vector<typename Phase::Sums::Block>& sums,
                      const Phase& phase) {
  const int blocks = rows.count();
  const int blocks_of_a_task = std::clamp(blocks / detail::min_tasks, 1, detail::max_blocks);
  sums.resize(static_cast<std::size_t>(blocks));
  Deal tasks((blocks + blocks_of_a_task - 1) / blocks_of_a_task,
             tbb::this_task_arena::max_concurrency());
  for_pieces(tasks, [&](int task) {
    const int first = task * blocks_of_a_task, last = std::min(blocks, first + blocks_of_a_task);
    detail::ActiveOfTask<At> list;
    for (int block = first; block < last; ++block)
      list.add_block(block - first, entry(rows.begin, block), entry(rows.begin, block + 1), phase);
    const detail::ActiveWalk<At, Phase> walk{list, phase, rows.begin.back() > rows_in_cache};
    walk.begin();
    std::size_t at = 0;
    for (int block = first; block < last; ++block) {
      const std::size_t end = entry(list.end, block - first);
      entry(sums, block) = walk.look_at(at, end);
      at = end;
    }
  });
}

}  // namespace pulvis
