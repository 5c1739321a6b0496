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
  const unsigned before = _mm_getcsr();
  _mm_setcsr(before | 0x8040U);
  const unsigned inside = interruptible([] { return _mm_getcsr(); });
  _mm_setcsr(before);
  EXPECT_EQ(inside & 0x8040U, 0x8040U);
  EXPECT_EQ(interruptible([] { return _mm_getcsr(); }) & 0x8040U, before & 0x8040U);
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
