#include "cli/laboratory/volts/loop_rows.hpp"

#include <algorithm>
#include <cmath>

namespace pulvis::volts {

std::size_t end_of_loop(const LoopRows& rows, std::size_t begin) {
  std::size_t end = begin;
  while (end < rows.slope.size() && rows.slope[end] == rows.slope[begin] &&
         rows.load[end] == rows.load[begin])
    ++end;
  if (rows.position.empty()) return end;
  const auto own = rows.position.subspan(begin, end - begin);
  const auto [low, high] = std::ranges::minmax(own);
  for (std::size_t i = 1; i < own.size(); ++i) {
    const double before = std::abs(own[i - 1] - own[0]), now = std::abs(own[i] - own[0]);
    if (before - now > (high - low) / 2) return begin + i;
  }
  return end;
}

}  // namespace pulvis::volts
