// What a list of seeds must satisfy, in studies and probes.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

namespace pulvis {

// A seed given twice would count the same run as two independent ones.
inline constexpr const char* repeated_seed = "a seed is given twice, allowed: each once";

inline bool repeats_a_seed(std::vector<std::int64_t> seeds) {
  std::ranges::sort(seeds);
  return std::ranges::adjacent_find(seeds) != seeds.end();
}

}  // namespace pulvis
