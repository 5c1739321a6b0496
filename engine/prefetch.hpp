// Prefetching of a cache line before it is needed.
#pragma once

namespace pulvis {

// g++ 12 considers a function that only prefetches to have no effect and drops its calls; the
// empty statement prevents that.
[[gnu::always_inline]] inline void prefetch(const void* line) {
  __builtin_prefetch(line);
  asm volatile("");
}

[[gnu::always_inline]] inline void prefetch_to_second_cache(const void* line) {
  __builtin_prefetch(line, 0, 2);
  asm volatile("");
}

}  // namespace pulvis
