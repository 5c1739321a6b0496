// The failure of a step that is reported: the first one in the order of the step list, then of the chunks, whichever
// is noticed first. So it does not depend on the number of threads.
#pragma once

#include <mutex>
#include <string>
#include <utility>

namespace pulvis {

class StepFailure {
 public:
  explicit operator bool() const { return !message_.empty(); }

  // Callable from any thread.
  void note(int system, int chunk, const char* message) {
    const std::lock_guard lock(mutex_);
    const std::pair at(system, chunk);
    if (*this && at_ <= at) return;
    message_ = message;
    at_ = at;
  }
  std::string take() { return std::exchange(message_, {}); }

 private:
  std::mutex mutex_;
  std::string message_;     // empty: none
  std::pair<int, int> at_;  // position in the step list, chunk
};

}  // namespace pulvis
