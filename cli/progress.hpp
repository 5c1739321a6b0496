// The progress line of a run: simulated time, steps and element updates per second, time left.
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>

namespace pulvis {

class Progress {
 public:
  // For a resumed run: how long it had run before, and up to which step.
  struct Before {
    double seconds = 0;
    std::int64_t step = 0;
  };
  Progress(double end, std::int64_t elements, bool shown, const Before& before);
  Progress(double end, std::int64_t elements, bool shown);
  // The simulated time at which the run will probably end.
  void expect_end(double time) { end_ = time; }
  // Cheap; prints a few times per second on a terminal, every ten seconds into a log.
  void show(double time, std::int64_t step);
  void finish();
  double seconds() const;  // of the run, including earlier sessions

 private:
  using Time = std::chrono::steady_clock;
  struct Mark {
    double wall = 0, time = 0;  // s
  };
  // s of wall time to come: as fast as in the last third, since steps get shorter and more expensive.
  double left(double wall, double time);

  double end_;
  std::int64_t elements_;
  bool is_shown_;
  Before before_;
  bool terminal_;
  Time::time_point start_, shown_;
  bool line_open_ = false;
  std::deque<Mark> marks_;  // of this session
};

}  // namespace pulvis
