// See tests/tsan/told.hpp.
#pragma once
#pragma GCC system_header
#include_next <oneapi/tbb/parallel_reduce.h>

#include "tests/tsan/told.hpp"

namespace tbb {
template <class Range, class Value, class Body, class Join>
Value told_parallel_reduce(const Range& range, const Value& identity, const Body& body,
                           const Join& join) {
  return told::ordered(
      body, [&](const auto& piece) { return parallel_reduce(range, identity, piece, join); });
}
}  // namespace tbb

#define parallel_reduce told_parallel_reduce
