#include "scenes/ranks/divide.hpp"

#include <algorithm>
#include <numeric>
#include <span>
#include <utility>

namespace pulvis {
namespace {

struct Division {
  const std::vector<std::array<double, 3>>& centre;
  const std::vector<double>& cost;
  std::vector<int>& owner;

  double at(int chunk, std::size_t axis) const {
    return centre[static_cast<std::size_t>(chunk)][axis];
  }
  std::size_t longest_axis(std::span<const int> chunks) const {
    std::size_t longest = 0;
    double most = -1;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [low, high] =
          std::ranges::minmax(chunks, {}, [&](int chunk) { return at(chunk, k); });
      const double length = at(high, k) - at(low, k);
      if (length <= most) continue;
      most = length;
      longest = k;
    }
    return longest;
  }
  void divide(std::span<int> chunks, int first_rank, int ranks) const {
    if (chunks.empty()) return;
    if (ranks == 1) {
      for (const int chunk : chunks) owner[static_cast<std::size_t>(chunk)] = first_rank;
      return;
    }
    const std::size_t axis = longest_axis(chunks);
    std::ranges::sort(chunks, {}, [&](int chunk) { return std::pair(at(chunk, axis), chunk); });
    const int low_ranks = ranks / 2;
    double all = 0;
    for (const int chunk : chunks) all += cost[static_cast<std::size_t>(chunk)];
    const double wanted = all * low_ranks / ranks;
    std::size_t low = 0;
    double sum = 0;
    // A chunk belongs to the side that has the larger part of it.
    while (low < chunks.size() &&
           sum + 0.5 * cost[static_cast<std::size_t>(chunks[low])] < wanted)
      sum += cost[static_cast<std::size_t>(chunks[low++])];
    divide(chunks.first(low), first_rank, low_ranks);
    divide(chunks.subspan(low), first_rank + low_ranks, ranks - low_ranks);
  }
};

}  // namespace

std::vector<int> divide_chunks(const std::vector<std::array<double, 3>>& centre,
                               const std::vector<double>& cost, int ranks) {
  std::vector<int> owner(centre.size()), chunks(centre.size());
  std::iota(chunks.begin(), chunks.end(), 0);
  Division{centre, cost, owner}.divide(chunks, 0, ranks);
  return owner;
}

}  // namespace pulvis
