#include "engine/workers.hpp"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>
#include <oneapi/tbb/task_scheduler_observer.h>

#include "engine/instruction_set.hpp"

namespace pulvis {
namespace {

// Denormals halve the speed in the fading tail of a wave and have no physical meaning.
class DenormalsToZero : public tbb::task_scheduler_observer {
 public:
  explicit DenormalsToZero(tbb::task_arena& arena) : tbb::task_scheduler_observer(arena) {
    observe(true);
  }
  ~DenormalsToZero() override { observe(false); }
  void on_scheduler_entry(bool) override { set_floating_mode(floating_mode() | denormals_to_zero); }
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
  const FloatingMode before = floating_mode();
  arena_->arena.execute(body);
  set_floating_mode(before);
}

}  // namespace pulvis
