// The progress line of a run: simulated time, steps and element-updates a second, time left.
#pragma once

#include <chrono>
#include <cstdint>

namespace pulvis {

class Progress {
 public:
  Progress(double end, std::int64_t elements);
  // Cheap; prints a few times a second on a terminal, every ten seconds into a log.
  void show(double time, std::int64_t step);
  void finish();
  double seconds() const;

 private:
  using Time = std::chrono::steady_clock;
  double end_;
  std::int64_t elements_;
  bool terminal_;
  Time::time_point start_, shown_;
  bool line_open_ = false;
};

}  // namespace pulvis
