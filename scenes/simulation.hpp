// A scene being run: its world, its threads and its step. What the command line, the benchmarks and the
// tests drive.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>

#include "components/run_state.hpp"
#include "engine/ranks/ranks.hpp"
#include "engine/workers.hpp"
#include "engine/world.hpp"
#include "scenes/ranks/crew.hpp"
#include "scenes/spec/scene.hpp"
#include "systems/step.hpp"

namespace pulvis {

class Simulation {
 public:
  // `ranks`: this process holds a share of the scene, and all ranks make the same calls.
  explicit Simulation(const Scene& scene, int threads = 1, Ranks* ranks = nullptr);
  ~Simulation();

  // Of this process: of several ranks its share.
  World& world() { return *world_; }
  // Where results are taken: the same, or on the root of several ranks what was fetched of the whole scene.
  World& whole() { return crew_ ? crew_->whole() : *world_; }
  const Clock& clock() const { return world_->resource<Clock>(); }
  const GraphPlan& plan() const { return step_->plan(); }
  std::vector<SystemCost> costs() const;
  bool finished() const { return clock().time >= end(); }

  // Runs plain steps while t_n < `time` and the end of the run, which may come early; `stop` is asked after every step and ends it early. Afterwards
  // t_n >= time, and positions, but not yet the forces, belong to t_n. Throws RunFailure.
  void run_until(double time, const std::function<bool()>& stop = {});
  // Completes the state at t_n: forces, tool reactions, energies.
  void observe();
  // Goes on from an observed state to t_(n+1).
  void move();
  // The same, `count` times.
  void run_steps(std::int64_t count);

  // ---- of several ranks; the others do nothing
  // Fetches contact rows, or a column of a checkpoint; leave() when they are no longer needed.
  void fetch_rows();
  ColumnVisit visit();
  std::vector<double> rank_memory() const {
    return crew_ ? crew_->memory() : std::vector<double>();
  }
  double bytes_a_step() const { return crew_ ? crew_->bytes_a_step() : 0; }
  Balance* balance() { return crew_ ? &crew_->balance() : nullptr; }  // null of one process
  void leave();
  void restore(const Checkpoint& checkpoint);
  // Not the root: does what the root does, until that has done.
  void follow();

  // ---- of one process or of several ranks
  // Values of all particles by number; of a field of mesh_values.
  void visit_mesh(std::size_t field, const ValueSink& take);
  std::string state_hash();

 private:
  double end() const;  // s, of the run
  void tell(Order order);
  void do_run(double time, const std::function<bool()>& stop);
  bool goes_on(bool stops);
  void do_observe(const Order& order);
  std::unique_ptr<World> world_;
  Workers workers_;
  std::unique_ptr<Step> step_;
  std::vector<SystemCost> costs_before_;  // of graphs that were made anew
  std::unique_ptr<Crew> crew_;
  std::unique_ptr<WholeObservers> observers_;  // of the root
};

}  // namespace pulvis
