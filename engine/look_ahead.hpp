// Prefetches the memory that the next systems will need while the current one computes: if the state is
// larger than the caches, memory access and computation then overlap.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include "engine/component.hpp"
#include "engine/prefetch.hpp"

namespace pulvis {

// What to prefetch, in order.
class LookAhead {
 public:
  void add(std::span<const std::byte> memory) {
    if (!memory.empty() && count_ < maximum) parts_[count_++] = memory;
  }
  bool empty() const { return count_ == 0; }
  // Returns the number of cache lines requested.
  int fetch() {
    int line = 0;
    for (; line < lines_of_a_call && at_ < count_; ++line) {
      std::span<const std::byte>& part = parts_[at_];
      prefetch_to_second_cache(part.data());
      part = part.subspan(std::min(part.size(), line_bytes));
      if (part.empty()) ++at_;
    }
    return line;
  }

 private:
  // Two systems that call it once per element are enough for all columns of a plastic body.
  static constexpr int lines_of_a_call = 8;
  static constexpr std::size_t maximum = 24, line_bytes = 64;
  std::array<std::span<const std::byte>, maximum> parts_;
  std::size_t count_ = 0, at_ = 0;
};

// The chunk of a compute-bound system. What to prefetch follows from the declarations of
// the systems after it; see TaskGraph.
struct BusyChunk : Chunk {
  // Calls body(i) for 0 <= i < elements and prefetches meanwhile. If everything fits in the caches, a loop without
  // prefetching is used: the extra call would cost a tenth.
  template <class Body>
  void for_elements(int elements, const Body& body) const {
    if (ahead == nullptr) {
      for (int i = 0; i < elements; ++i) body(i);
    } else {
      for (int i = 0; i < elements; ++i) {
        ahead->fetch();
        body(i);
      }
    }
  }
};

}  // namespace pulvis
