// See tests/tsan/told.hpp.
#pragma once
#pragma GCC system_header
#include_next <oneapi/tbb/parallel_for.h>

#include "tests/tsan/told.hpp"

namespace tbb {
template <class Index, class Body>
void told_parallel_for(Index first, Index last, const Body& body) {
  told::ordered(body, [&](const auto& piece) { parallel_for(first, last, piece); });
}
template <class Range, class Body>
void told_parallel_for(const Range& range, const Body& body) {
  told::ordered(body, [&](const auto& piece) { parallel_for(range, piece); });
}
}  // namespace tbb

#define parallel_for told_parallel_for
