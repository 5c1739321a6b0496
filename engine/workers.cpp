#include "engine/workers.hpp"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>
#include <oneapi/tbb/task_scheduler_observer.h>
#include <xmmintrin.h>

namespace pulvis {
namespace {

// Denormals halve the speed in the fading tail of a wave and have no physical meaning.
class DenormalsToZero : public tbb::task_scheduler_observer {
 public:
  explicit DenormalsToZero(tbb::task_arena& arena) : tbb::task_scheduler_observer(arena) {
    observe(true);
  }
  ~DenormalsToZero() override { observe(false); }
  void on_scheduler_entry(bool) override { _mm_setcsr(_mm_getcsr() | 0x8040); }
};

}  // namespace

struct Workers::Arena {
  explicit Arena(int threads)
      : limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads)),
        arena(threads),
        denormals(arena) {}

  tbb::global_control limit;
  tbb::task_arena arena;
  DenormalsToZero denormals;
};

Workers::Workers(int threads) : arena_(std::make_unique<Arena>(threads)) {}
Workers::~Workers() = default;

void Workers::run(const std::function<void()>& body) {
  const unsigned before = _mm_getcsr();
  arena_->arena.execute(body);
  _mm_setcsr(before);
}

}  // namespace pulvis
