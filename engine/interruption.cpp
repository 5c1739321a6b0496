#include "engine/interruption.hpp"

#include <atomic>

namespace pulvis {
namespace {

std::atomic<bool> asked{false};
static_assert(std::atomic<bool>::is_always_lock_free);  // a signal handler sets it

}  // namespace

void ask_to_stop() noexcept { asked = true; }
bool asked_to_stop() noexcept { return asked; }

void withdraw_wish_to_stop() noexcept { asked = false; }

void stop_if_asked() {
  if (asked_to_stop()) throw Interrupted();
}

}  // namespace pulvis
