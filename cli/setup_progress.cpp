#include "cli/setup_progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

#include "cli/tell.hpp"
#include "engine/activity.hpp"

namespace pulvis {

SetupProgress::SetupProgress(bool shown, std::chrono::milliseconds first)
    : terminal_(isatty(STDERR_FILENO) != 0) {
  if (shown) thread_ = std::thread([this, first] { watch(first); });
}

SetupProgress::~SetupProgress() {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    over_ = true;
  }
  ended_.notify_one();
  thread_.join();
  if (line_open_) put(stderr, "\r\033[K");
  flush(stderr);
}

void SetupProgress::watch(std::chrono::milliseconds first) {
  std::unique_lock lock(mutex_);
  std::chrono::milliseconds wait = first;
  while (!ended_.wait_for(lock, wait, [this] { return over_; })) {
    show();
    wait = terminal_ ? std::chrono::seconds(1) : std::chrono::seconds(10);
  }
}

void SetupProgress::show() {
  const double seconds = std::chrono::duration<double>(Time::now() - start_).count();
  const std::string what = Activity::current();
  const std::string line = printable(fmt::format("pulvis: preparing the scene, {:.0f} s so far{}{}",
                                                 seconds, what.empty() ? "" : ": ", what));
  put(stderr, terminal_ ? "\r\033[K" + line : line + "\n");
  flush(stderr);
  line_open_ = terminal_;
}

}  // namespace pulvis
