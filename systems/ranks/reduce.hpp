// What all ranks find together. One process has it already.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "components/ranks.hpp"
#include "engine/access.hpp"
#include "engine/ranks/exact_sum.hpp"

namespace pulvis {

using Link = Optional<Write<RankLink>>;
// And where a system looks at the border, too, the outlines of it.
template <class Position>
struct BorderOutlines {
  Write<RankLink> link;
  Write<Position> outlines;
};

// Null where there is one process.
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

// The same at the end of a step, and with it what broke, and what a rank wishes.
inline void agree(RankLink& link, std::span<double> numbers) {
  constexpr int bits = 32;
  std::vector<double> all(numbers.begin(), numbers.end());
  for (int bit = 0; bit < bits; ++bit) all.push_back(static_cast<double>(link.wishes >> bit & 1U));
  all.push_back(link.failure.empty() ? 0 : 1);
  link.ranks->maximum(all);
  std::copy_n(all.begin(), numbers.size(), numbers.begin());
  link.agreed = 0;
  for (std::size_t bit = 0; bit < bits; ++bit)
    if (all[numbers.size() + bit] > 0) link.agreed |= 1U << bit;
  link.any_failed = all.back() > 0;
}

inline void sum_of_ranks(const Link& link, std::span<ExactSum> sums) {
  RankLink* own = link_of(link);
  if (own == nullptr) return;
  std::vector<std::int64_t> numbers;
  numbers.reserve(sums.size() * ExactSum::numbers);
  for (ExactSum& sum : sums)
    numbers.insert(numbers.end(), sum.carried().begin(), sum.carried().end());
  own->ranks->sum(numbers);
  for (std::size_t i = 0; i < sums.size(); ++i)
    sums[i] = ExactSum::of(std::span(numbers).subspan(i * ExactSum::numbers, ExactSum::numbers));
}
inline void sum_of_ranks(const Link& link, std::span<std::int64_t> numbers) {
  if (RankLink* own = link_of(link)) own->ranks->sum(numbers);
}

}  // namespace pulvis
