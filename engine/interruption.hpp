// Interrupting long computations. A signal sets a stop request; long computations check it where they can stop.
#pragma once

#include <chrono>
#include <exception>
#include <future>
#include <thread>
#include <utility>

#include "engine/instruction_set.hpp"

namespace pulvis {

// The work was abandoned half done: the data it was changing must not be used any more.
class Interrupted : public std::exception {
 public:
  const char* what() const noexcept override { return "interrupted"; }
};

void ask_to_stop() noexcept;  // may be called from a signal handler
bool asked_to_stop() noexcept;
void stop_if_asked();  // throws Interrupted
// For a program that keeps running: clears the stop request once it has been handled.
void withdraw_wish_to_stop() noexcept;

// Runs work of a library that cannot be interrupted in a separate thread with the caller's floating-point mode.
// If a stop request comes first, the thread is abandoned and Interrupted is thrown: `work` must own everything
// it touches, and the process is about to exit.
template <class Work>
auto interruptible(Work work) {
  std::packaged_task<decltype(work())()> task(
      [work = std::move(work), mode = floating_mode()]() mutable {
        set_floating_mode(mode);
        return work();
      });
  auto result = task.get_future();
  std::thread(std::move(task)).detach();
  constexpr auto between_looks = std::chrono::milliseconds(20);
  while (result.wait_for(between_looks) != std::future_status::ready) stop_if_asked();
  return result.get();
}

}  // namespace pulvis
