// Lists sorted by slot, built by several threads: the share of every slot is found independently, and shares
// are concatenated in order, so that the list does not depend on which thread found what.
#pragma once

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "engine/entry.hpp"

namespace pulvis {

template <class T>
struct BySlot {
  std::vector<std::int32_t> begin;  // [slots + 1] into all
  std::vector<T> all;

  static BySlot none(int slots) {
    return {std::vector<std::int32_t>(static_cast<std::size_t>(slots) + 1), {}};
  }
  std::span<const T> of(int slot) const {
    return std::span(all).subspan(static_cast<std::size_t>(entry(begin, slot)),
                                  static_cast<std::size_t>(count(slot)));
  }
  int count(int slot) const { return entry(begin, slot + 1) - entry(begin, slot); }
};

inline constexpr int slots_of_a_block = 32;  // one task per block

template <class Visit>
void for_blocks_of_slots(int slots, const Visit& visit) {
  tbb::parallel_for(0, (slots + slots_of_a_block - 1) / slots_of_a_block, [&](int block) {
    visit(block, block * slots_of_a_block, std::min((block + 1) * slots_of_a_block, slots));
  });
}

template <class Visit>
void for_slots(int slots, const Visit& visit) {
  for_blocks_of_slots(slots, [&](int, int first, int last) {
    for (int slot = first; slot < last; ++slot) visit(slot);
  });
}

// find(slot, list) appends the entries of the slot.
template <class T, class Find>
BySlot<T> list_by_slot(int slots, const Find& find) {
  BySlot<T> list;
  list.begin.assign(static_cast<std::size_t>(slots) + 1, 0);
  std::vector<std::vector<T>> found(static_cast<std::size_t>(slots / slots_of_a_block) + 1);
  for_blocks_of_slots(slots, [&](int block, int first, int last) {
    std::vector<T>& mine = entry(found, block);
    for (int slot = first; slot < last; ++slot) {
      const std::size_t before = mine.size();
      find(slot, mine);
      entry(list.begin, slot + 1) = static_cast<std::int32_t>(mine.size() - before);
    }
  });
  std::partial_sum(list.begin.begin(), list.begin.end(), list.begin.begin());
  list.all.resize(static_cast<std::size_t>(list.begin.back()));
  for_blocks_of_slots(slots, [&](int block, int first, int) {
    std::ranges::copy(entry(found, block), list.all.begin() + entry(list.begin, first));
  });
  return list;
}

}  // namespace pulvis
