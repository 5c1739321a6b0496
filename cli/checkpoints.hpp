// When a run writes its checkpoints, and from which one `pulvis resume` goes on.
#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <stdexcept>

#include "engine/files/checkpoint.hpp"
#include "scenes/read.hpp"

namespace pulvis {

struct CheckpointOptions {
  double every = 60;            // s of wall time
  double time = 0;              // and every so much simulated time, s; 0: no
  std::int64_t steps = 0;       // and every so many steps (increments of an AFM scene); 0: no
  std::int64_t stop_after = 0;  // this step the run stops as if it were interrupted; 0: it does not
};

class Checkpoints {
 public:
  Checkpoints(const LoadedScene& scene, std::filesystem::path folder,
              const CheckpointOptions& options);

  // Cheap: asked after every step. The first one is due at once, so that whatever is killed can go on. The
  // wall time's are put off while they would cost more than a hundredth of the run.
  bool due(std::int64_t step, double time) const;
  bool stops(std::int64_t step) const {
    return options_.stop_after > 0 && step >= options_.stop_after;
  }
  void resumed(std::int64_t step, double time) {
    last_step_ = step;
    info_.time = time;
  }
  void of_run(const std::string& id) { info_.run = id; }
  // `world`: the parts that were kept of one, or one that holds a column when `visit` has fetched it.
  void write(std::int64_t step, double time, const StateParts& world, const StateParts& run);
  void write(std::int64_t step, double time, const World& world, const StateParts& run,
             const ColumnVisit& visit = {});
  // As a state that other runs may begin with.
  void keep_state(const std::string& name, std::int64_t step, double time,
                  const World& world, const ColumnVisit& visit) const;
  // Nothing is left to go on with.
  void remove() const { remove_checkpoints(folder_); }

 private:
  template <class Write>
  void written(std::int64_t step, double time, const Write& write);

  using Time = std::chrono::steady_clock;
  CheckpointInfo info_;
  std::filesystem::path folder_;
  CheckpointOptions options_;
  std::int64_t last_step_ = -1;
  Time::time_point last_ = Time::now();
  Time::duration cost_{};
};

// The folder has no run that can go on; says why.
class CannotResume : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// A run that stopped: its newest whole checkpoint and its scene. Damaged ones are named on the terminal.
struct StoppedRun {
  std::unique_ptr<Checkpoint> checkpoint;
  LoadedScene scene;
};
void require_stopped_run(
    const std::filesystem::path& folder);  // one that could be: throws CannotResume
StoppedRun find_stopped_run(const std::filesystem::path& folder);
// Takes away what nobody can go on from here: checkpoints of other runs than `run`, and halves of some.
void clear_other_checkpoints(const std::filesystem::path& folder, const std::string& run);
// Whether `resume` would take up what stopped there, and that is a run of the scene of this hash.
bool can_go_on(const std::filesystem::path& folder, std::uint64_t scene_hash);

}  // namespace pulvis
