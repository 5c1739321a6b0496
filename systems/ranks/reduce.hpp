// Reductions over all ranks. With one process the local result is the result.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "components/ranks.hpp"
#include "engine/access.hpp"
#include "engine/ranks/exact_sum.hpp"

namespace pulvis {

using Link = Optional<Write<RankLink>>;
// For systems that also read the border: its outlines.
template <class Position>
struct BorderOutlines {
  Write<RankLink> link;
  Write<Position> outlines;
};

// Null if there is one process.
inline RankLink* link_of(const Link& link) { return link ? &**link : nullptr; }
template <class Position>
RankLink* link_of(const Optional<BorderOutlines<Position>>& border) {
  return border ? &*border->link : nullptr;
}

template <class L>
void maximum_of_ranks(const L& link, std::span<double> numbers) {
  if (RankLink* own = link_of(link)) own->ranks->maximum(numbers);
}
template <class L>
double maximum_of_ranks(const L& link, double number) {
  maximum_of_ranks(link, std::span(&number, 1));
  return number;
}
template <class L>
double minimum_of_ranks(const L& link, double number) {
  return -maximum_of_ranks(link, -number);
}

// The same at the end of a step, combined with whether anything failed on any rank.
inline void agree(RankLink& link, std::span<double> numbers) {
  std::vector<double> all(numbers.begin(), numbers.end());
  all.push_back(link.failure.empty() ? 0 : 1);
  link.ranks->maximum(all);
  std::copy_n(all.begin(), numbers.size(), numbers.begin());
  link.any_failed = all.back() > 0;
}

// Exact sums and counts, with one message.
inline void sum_of_ranks(const Link& link, std::span<ExactSum> sums,
                         std::span<std::int64_t> counts = {}) {
  RankLink* own = link_of(link);
  if (own == nullptr) return;
  std::vector<std::int64_t> numbers(counts.begin(), counts.end());
  for (ExactSum& sum : sums)
    numbers.insert(numbers.end(), sum.carried().begin(), sum.carried().end());
  own->ranks->sum(numbers);
  std::copy_n(numbers.begin(), counts.size(), counts.begin());
  std::span<const std::int64_t> left = std::span(numbers).subspan(counts.size());
  for (ExactSum& sum : sums) {
    sum = ExactSum::of(left.first(ExactSum::numbers));
    left = left.subspan(ExactSum::numbers);
  }
}

}  // namespace pulvis
