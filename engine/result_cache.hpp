// Caches the latest results of long computations, looked up by their input.
#pragma once

#include <algorithm>
#include <cstddef>
#include <deque>
#include <mutex>
#include <utility>

namespace pulvis {

// Thread-safe. Keys are compared by ==, so a result is only reused for bitwise equal input.
template <class Key, class Result>
class ResultCache {
 public:
  // Limit on the total size; the oldest results are evicted first. A larger result is not kept.
  explicit ResultCache(std::size_t most) : most_(most) {}

  // make(key), unless its result is cached; two threads may both compute it.
  template <class Make, class Size>
  Result get(const Key& key, const Make& make, const Size& size_of) {
    {
      const std::lock_guard lock(mutex_);
      const auto found = std::ranges::find(results_, key, &Made::key);
      if (found != results_.end()) return found->result;
    }
    Made made{key, make(key), 0};
    made.size = size_of(made.result);
    const Result result = made.result;
    if (made.size > most_) return result;
    const std::lock_guard lock(mutex_);
    size_ += made.size;
    results_.push_back(std::move(made));
    for (; size_ > most_; results_.pop_front()) size_ -= results_.front().size;
    return result;
  }

 private:
  struct Made {
    Key key;
    Result result;
    std::size_t size;
  };
  std::size_t most_, size_ = 0;
  std::mutex mutex_;
  std::deque<Made> results_;  // oldest first
};

}  // namespace pulvis
