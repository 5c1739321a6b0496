// Groups of particles held together by bonds.
//
// Source   disjoint sets with path halving: Tarjan & van Leeuwen, J. ACM 31(2), 245 (1984). The root of a set is its
//          lowest number, so that the result does not depend on the order of the bonds
#pragma once

#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "engine/entry.hpp"

namespace pulvis::kernels {

class DisjointSets {
 public:
  explicit DisjointSets(int count) : parent_(static_cast<std::size_t>(count)) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }
  // The lowest number of the set.
  std::int32_t root(std::int32_t i) {
    while (entry(parent_, i) != i) i = entry(parent_, i) = entry(parent_, entry(parent_, i));
    return i;
  }
  void join(std::int32_t a, std::int32_t b) {
    a = root(a), b = root(b);
    if (b < a) std::swap(a, b);
    entry(parent_, b) = a;
  }
  std::vector<std::int32_t> roots() {
    std::vector<std::int32_t> all(parent_.size());
    for (std::int32_t i = 0; i < static_cast<std::int32_t>(all.size()); ++i)
      entry(all, i) = root(i);
    return all;
  }

 private:
  std::vector<std::int32_t> parent_;
};

}  // namespace pulvis::kernels
