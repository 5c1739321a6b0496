// The step: the one ordered list of systems, and the task graphs built from it.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/task_graph.hpp"
#include "systems/step_failure.hpp"

namespace pulvis {

// The systems that a world's columns require, in order. The forces at t_n and the motion to t_(n+1) are
// separate so that output can be taken in between, where positions, stresses and forces are consistent.
struct StepList {
  std::vector<System> forces;
  std::vector<System> observe;  // energies, on sampled steps
  std::vector<System> motion;
};

StepList step_list(World& world);

// What must be known before the first step: contact curves, the stable time step and the step taken.
std::vector<System> start_list(World& world);

// Observers of the powder as a whole, on the root of several ranks: in the world that gathers the results of all ranks.
class WholeObservers {
 public:
  explicit WholeObservers(World& whole);
  void run();
  // Names of what they read and write: "contact/touches".
  const std::vector<std::string>& looks_at() const { return looks_at_; }

 private:
  WholeObservers(const std::vector<System>& systems, World& whole);
  std::vector<std::string> looks_at_;
  TaskGraph observe_;
};

// A step as used by the run loop.
class Step {
 public:
  explicit Step(World& world);
  void start();    // once
  void run();      // forces and motion, fused
  void observe();  // forces and energies at t_n...
  void move();     // ...and then the motion that completes the step
  const GraphPlan& plan() const { return whole_.plan(); }
  // Names of the systems that only sampled steps run, in order.
  std::vector<std::string> sampled_systems() const;
  std::vector<SystemCost> costs() const;  // plain and sampled steps together

 private:
  void run_to_next(TaskGraph& systems);
  void end_of_step();

  World& world_;
  std::unique_ptr<StepFailure> failure_;  // of a world without ranks
  TaskGraph whole_, observed_, motion_;
};

}  // namespace pulvis
