// Distributes work items to threads so that each thread finds its data from earlier stages in its caches.
#pragma once

#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace pulvis {

// Pieces 0 ... pieces - 1: chunks, or blocks of rows in the order of their particles. A thread takes its share
// first, in order: the same pieces in every stage and every step. A thread with none left steals the
// last piece of another thread. Which thread computes a piece does not affect the results, bit for bit.
class Deal {
 public:
  Deal(int pieces, int threads) : pieces_(pieces), shares_(static_cast<std::size_t>(threads)) {
    restart();
  }
  int pieces() const { return static_cast<int>(pieces_); }
  // Makes all pieces available again. No thread may be taking pieces meanwhile.
  void restart() {
    const auto threads = static_cast<std::int64_t>(shares_.size());
    for (std::int64_t t = 0; t < threads; ++t)
      shares_[static_cast<std::size_t>(t)].bounds.store(
          packed(pieces_ * t / threads, pieces_ * (t + 1) / threads), std::memory_order_relaxed);
  }
  // The next piece for the calling thread, whose arena must not have more threads than shares; none when
  // all are taken.
  std::optional<int> take() {
    const auto thread = static_cast<std::size_t>(tbb::this_task_arena::current_thread_index());
    for (std::size_t k = 0; k < shares_.size(); ++k) {
      const bool own = k == 0;
      std::atomic<std::uint64_t>& bounds = shares_[(thread + k) % shares_.size()].bounds;
      std::uint64_t now = bounds.load(std::memory_order_relaxed);
      while (first(now) < last(now)) {
        const std::uint64_t less =
            own ? packed(first(now) + 1, last(now)) : packed(first(now), last(now) - 1);
        if (bounds.compare_exchange_weak(now, less, std::memory_order_relaxed))
          return static_cast<int>(own ? first(now) : last(now) - 1);
      }
    }
    return std::nullopt;
  }

 private:
  struct alignas(64) Share {  // [first, last) that are left, in one number; separate cache lines
    std::atomic<std::uint64_t> bounds = 0;
  };
  static std::uint64_t packed(std::int64_t first, std::int64_t last) {
    return static_cast<std::uint64_t>(first) << 32 | static_cast<std::uint64_t>(last);
  }
  static std::int64_t first(std::uint64_t bounds) {
    return static_cast<std::int64_t>(bounds >> 32);
  }
  static std::int64_t last(std::uint64_t bounds) {
    return static_cast<std::int64_t>(bounds & 0xffffffff);
  }

  std::int64_t pieces_;
  std::vector<Share> shares_;
};

// Calls body(piece) for all pieces not yet taken, on all threads of the arena. Returns when these are
// done; does not wait for pieces taken by others before.
template <class Body>
void for_pieces(Deal& deal, const Body& body) {
  tbb::parallel_for(0, deal.pieces(), [&](int) {
    if (const std::optional<int> piece = deal.take()) body(*piece);
  });
}

}  // namespace pulvis
