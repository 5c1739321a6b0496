// CPU time in s since some moment. It advances only while the process computes or busy-waits.
#pragma once

#include <time.h>

namespace pulvis {

inline double seconds_on(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}
inline double process_seconds() { return seconds_on(CLOCK_PROCESS_CPUTIME_ID); }  // of all threads
inline double thread_seconds() { return seconds_on(CLOCK_THREAD_CPUTIME_ID); }

}  // namespace pulvis
