#include "cli/setup_progress.hpp"

#include <gtest/gtest.h>

#include "engine/activity.hpp"

namespace pulvis {
namespace {

using namespace std::chrono_literals;

// What it prints in a tenth of a second of some activity.
std::string printed(bool shown, std::chrono::milliseconds first) {
  ::testing::internal::CaptureStderr();
  {
    const SetupProgress progress(shown, first);
    const Activity outer("a scene");
    const Activity inner("mesh of 8 elements");
    std::this_thread::sleep_for(100ms);
  }
  return ::testing::internal::GetCapturedStderr();
}

TEST(SetupProgress, NamesWhatIsBeingDone) {
  EXPECT_EQ(printed(true, 10ms), "pulvis: preparing the scene, 0 s so far: mesh of 8 elements\n");
}

TEST(SetupProgress, IsSilentForShortAndForQuietSetups) {
  EXPECT_EQ(printed(true, 5s), "");
  EXPECT_EQ(printed(false, 10ms), "");
}

TEST(SetupProgress, TheInnermostActivityCountsWhileItLasts) {
  EXPECT_EQ(Activity::current(), "");
  const Activity outer("outer");
  {
    const Activity inner("inner");
    EXPECT_EQ(Activity::current(), "inner");
  }
  EXPECT_EQ(Activity::current(), "outer");
}

}  // namespace
}  // namespace pulvis
