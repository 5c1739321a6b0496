// A scene being run: its world, its threads and its step. What the command line, the benchmarks and the
// tests drive.
#pragma once

#include <functional>
#include <memory>

#include "components/run_state.hpp"
#include "engine/workers.hpp"
#include "engine/world.hpp"
#include "scenes/spec/scene.hpp"
#include "systems/step.hpp"

namespace pulvis {

class Simulation {
 public:
  explicit Simulation(const Scene& scene, int threads = 1);
  ~Simulation();

  World& world() { return *world_; }
  const Clock& clock() const { return world_->resource<Clock>(); }
  const GraphPlan& plan() const { return step_->plan(); }
  std::vector<SystemCost> costs() const { return step_->costs(); }
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

 private:
  double end() const;  // s, of the run
  std::unique_ptr<World> world_;
  Workers workers_;
  std::unique_ptr<Step> step_;
};

}  // namespace pulvis
