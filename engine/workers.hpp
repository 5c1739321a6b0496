// The threads of a run: a fixed number, each flushing denormals to zero.
#pragma once

#include <immintrin.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>
#include <oneapi/tbb/task_scheduler_observer.h>

#include <functional>

namespace pulvis {

// Denormal numbers halve the speed of a wave's fading tail and carry no physics.
class DenormalsToZero : public tbb::task_scheduler_observer {
 public:
  explicit DenormalsToZero(tbb::task_arena& arena) : tbb::task_scheduler_observer(arena) {
    observe(true);
  }
  ~DenormalsToZero() override { observe(false); }
  void on_scheduler_entry(bool) override { _mm_setcsr(_mm_getcsr() | 0x8040); }
};

class Workers {
 public:
  explicit Workers(int threads)
      : limit_(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads)),
        arena_(threads),
        denormals_(arena_) {}

  // Runs `body` inside the arena. The calling thread's own floating-point mode is put back after.
  void run(const std::function<void()>& body) {
    const unsigned before = _mm_getcsr();
    arena_.execute(body);
    _mm_setcsr(before);
  }

 private:
  tbb::global_control limit_;
  tbb::task_arena arena_;
  DenormalsToZero denormals_;
};

}  // namespace pulvis
