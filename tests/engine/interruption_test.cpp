// Work that cannot be asked to stop is left to itself when its process is.
#include "engine/interruption.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <memory>
#include <stdexcept>

namespace pulvis {
namespace {

TEST(Interruption, WorkGivesItsResultAndItsException) {
  EXPECT_EQ(*interruptible([] { return std::make_unique<int>(7); }), 7);
  EXPECT_THROW(interruptible([]() -> int { throw std::runtime_error("bad"); }), std::runtime_error);
}

// Denormals are flushed or not as where the work was asked for: the same bits with the thread as without.
TEST(Interruption, WorkHasTheCallersFloatingPointMode) {
  const FloatingMode before = floating_mode();
  set_floating_mode(before | denormals_to_zero);
  const FloatingMode inside = interruptible([] { return floating_mode(); });
  set_floating_mode(before);
  EXPECT_EQ(inside & denormals_to_zero, denormals_to_zero);
  EXPECT_EQ(interruptible([] { return floating_mode(); }) & denormals_to_zero,
            before & denormals_to_zero);
}

TEST(Interruption, EndlessWorkIsLeft) {
  const auto leaves = [] {
    std::thread([] {
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
      ask_to_stop();
    }).detach();
    try {
      interruptible([] {
        while (true) std::this_thread::sleep_for(std::chrono::hours(1));
        return 0;
      });
    } catch (const Interrupted&) {
      std::_Exit(42);
    }
    std::_Exit(1);
  };
  EXPECT_EXIT(leaves(), ::testing::ExitedWithCode(42), "");
}

}  // namespace
}  // namespace pulvis
