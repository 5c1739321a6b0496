// A sign of life while a scene is read and built, which may take minutes: what is being computed (engine/activity.hpp).
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>

namespace pulvis {

// While it exists, a line on standard error after `first`, then every second on a terminal, every ten seconds into a log. The
// line on a terminal is cleared at the end.
class SetupProgress {
 public:
  explicit SetupProgress(bool shown = true,
                         std::chrono::milliseconds first = std::chrono::seconds(3));
  ~SetupProgress();
  SetupProgress(const SetupProgress&) = delete;
  SetupProgress& operator=(const SetupProgress&) = delete;

 private:
  using Time = std::chrono::steady_clock;
  void watch(std::chrono::milliseconds first);
  void show();

  Time::time_point start_ = Time::now();
  bool terminal_, line_open_ = false, over_ = false;
  std::mutex mutex_;
  std::condition_variable ended_;
  std::thread thread_;  // last: it uses the others
};

}  // namespace pulvis
