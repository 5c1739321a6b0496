// Asking for a cache line before it is needed.
#pragma once

namespace pulvis {

// g++ 12 takes a function that does nothing but prefetch for one without effect and drops its calls; the
// empty statement keeps them.
[[gnu::always_inline]] inline void prefetch(const void* line) {
  __builtin_prefetch(line);
  asm volatile("");
}

[[gnu::always_inline]] inline void prefetch_to_second_cache(const void* line) {
  __builtin_prefetch(line, 0, 2);
  asm volatile("");
}

}  // namespace pulvis
