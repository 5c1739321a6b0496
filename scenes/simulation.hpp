// A running scene: its world, its threads and its step. The command line, the benchmarks and the
// tests drive it.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>

#include "components/run_state.hpp"
#include "engine/ranks/ranks.hpp"
#include "engine/workers.hpp"
#include "engine/world.hpp"
#include "scenes/ranks/rank_group.hpp"
#include "scenes/spec/scene.hpp"
#include "systems/step.hpp"

namespace pulvis {

class Simulation {
 public:
  // `ranks`: this process holds a share of the scene, and all ranks make the same calls.
  explicit Simulation(const Scene& scene, int threads = 1, Ranks* ranks = nullptr);
  ~Simulation();

  // Of this process: with several ranks, its share.
  World& world() { return *world_; }
  // Where results are taken: the same or, on the root of several ranks, the gathered data of the whole scene.
  World& whole() { return group_ ? group_->whole() : *world_; }
  const Clock& clock() const { return world_->resource<Clock>(); }
  const GraphPlan& plan() const { return step_->plan(); }  // of plain steps
  std::vector<std::string> sampled_systems() const { return step_->sampled_systems(); }
  std::vector<SystemCost> costs() const;
  bool finished() const { return clock().time >= end(); }

  // Runs plain steps while t_n < `time` and the run has not ended, which may be early; `stop` is called after every step and ends it. Afterwards
  // t_n >= time, and positions, but not yet the forces, belong to t_n. Throws RunFailure.
  void run_until(double time, const std::function<bool()>& stop = {});
  // Completes the state at t_n: forces, tool reactions, energies.
  void observe();
  // Advances from an observed state to t_(n+1).
  void move();
  // The same, `count` times.
  void run_steps(std::int64_t count);

  // ---- with several ranks; a single process does nothing
  // Gathers contact rows, or a column of a checkpoint; call leave() when they are no longer needed.
  void fetch_rows();
  // For a checkpoint and for frames in this folder: the ranks write their parts, where its file system permits that.
  ColumnVisit visit(const std::filesystem::path& folder);
  FieldWriters field_writers(const std::filesystem::path& folder);
  // From now on the root writes everything, as it does where the file system does not permit the other.
  void write_from_root();
  std::vector<double> rank_memory() const {
    return group_ ? group_->memory() : std::vector<double>();
  }
  double bytes_a_step() const { return group_ ? group_->bytes_a_step() : 0; }
  Balance* balance() { return group_ ? &group_->balance() : nullptr; }  // null for one process
  void leave();
  void restore(const Checkpoint& checkpoint);
  // On ranks other than the root: takes part in what the root does, until it has finished.
  void follow();

  // ---- for one process or several ranks
  // Values of all particles by number, of one field of mesh_values.
  void visit_mesh(std::size_t field, const ValueSink& take);
  std::string state_hash();

 private:
  double end() const;  // s, of the run
  void tell(Command command);
  void command_write(Command command);
  void do_run(double time, const std::function<bool()>& stop);
  bool goes_on(bool stops);
  void do_observe(const Command& command);
  std::unique_ptr<World> world_;
  Workers workers_;
  std::unique_ptr<Step> step_;
  std::vector<SystemCost> costs_before_;  // of graphs that have been rebuilt
  std::unique_ptr<RankGroup> group_;
  std::unique_ptr<WholeObservers> observers_;  // on the root
};

}  // namespace pulvis
