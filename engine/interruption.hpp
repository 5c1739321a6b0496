// Asking long work to end. A signal leaves the wish here; work that takes long looks at it wherever it can stop.
#pragma once

#include <xmmintrin.h>

#include <chrono>
#include <exception>
#include <future>
#include <thread>
#include <utility>

namespace pulvis {

// Work was given up half done: what it was changing is not to be used any more.
class Interrupted : public std::exception {
 public:
  const char* what() const noexcept override { return "interrupted"; }
};

void ask_to_stop() noexcept;  // from a signal handler, too
bool asked_to_stop() noexcept;
void stop_if_asked();  // throws Interrupted
// Of a program that lives on: whoever asked has been answered.
void withdraw_wish_to_stop() noexcept;

// Work of a library that knows no way to stop, done by a thread of its own with the caller's floating-point mode.
// Where the wish to stop comes first, the thread is left to itself and Interrupted thrown: `work` owns all
// that it touches, and the process is about to end.
template <class Work>
auto interruptible(Work work) {
  std::packaged_task<decltype(work())()> task(
      [work = std::move(work), mode = _mm_getcsr()]() mutable {
        _mm_setcsr(mode);
        return work();
      });
  auto result = task.get_future();
  std::thread(std::move(task)).detach();
  constexpr auto between_looks = std::chrono::milliseconds(20);
  while (result.wait_for(between_looks) != std::future_status::ready) stop_if_asked();
  return result.get();
}

}  // namespace pulvis
