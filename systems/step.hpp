// The step: the one ordered list of systems, and the graphs made from it.
#pragma once

#include <string>
#include <vector>

#include "engine/task_graph.hpp"

namespace pulvis {

// The systems that a world's columns ask for, in order. The forces at t_n and the motion to t_(n+1) are
// apart so that a result can be taken between them, where positions, stresses and forces belong together.
struct StepList {
  std::vector<System> forces;
  std::vector<System> observe;  // energies, on sampled steps
  std::vector<System> motion;
};

StepList step_list(World& world);

// What has to be known before the first step: contact curves, the stable time step and the one that is taken.
std::vector<System> start_list(World& world);

// What looks at a powder as a whole, on the root of several ranks: at the world into which the results of all are fetched.
class WholeObservers {
 public:
  explicit WholeObservers(World& whole);
  void run();
  // What they read and write: "contact/touches".
  const std::vector<std::string>& looks_at() const { return looks_at_; }

 private:
  WholeObservers(const std::vector<System>& systems, World& whole);
  std::vector<std::string> looks_at_;
  TaskGraph observe_;
};

// A step as the run loop uses it.
class Step {
 public:
  explicit Step(World& world);
  void start();    // once
  void run();      // forces and motion, fused
  void observe();  // forces and energies at t_n...
  void move();     // ...and then the motion that finishes the step
  const GraphPlan& plan() const { return whole_.plan(); }
  std::vector<SystemCost> costs() const;  // of plain and of sampled steps together

 private:
  void end_of_step() const;

  World& world_;
  TaskGraph whole_, observed_, motion_;
};

}  // namespace pulvis
