// The task graph of a step, derived from what its systems declare.
//
// Chunk systems become passes: a pass is one stage, a parallel loop over chunks that runs its systems back to
// back while the chunk is in cache. Which ones make a pass is the graph's policy (Passes); the list says no
// more than an order. Two stages get an edge, in list order, when they touch the same component and one of
// them writes, or when one of them changes the length of a kind of entity that the other touches. Nobody writes edges.
// Stages without an edge between them run side by side.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "engine/system.hpp"

namespace pulvis {

struct StagePlan {
  std::vector<std::string> systems;
  bool by_chunk = false;
  std::vector<AccessInfo> accesses;  // union over its systems; write wins over read
  std::vector<int>
      taken_before;  // of small tasks: stages none of whose chunks is left to take when this one begins
};

// What a system has taken of all workers together. Only every 64th run is timed: looking at the clock costs
// little then, and a run of thousands of steps is told well.
struct SystemCost {
  std::string system;
  double seconds = 0;
};
// System by system, those of `one` first.
std::vector<SystemCost> added(std::vector<SystemCost> one, const std::vector<SystemCost>& other);

struct GraphPlan {
  std::vector<StagePlan> stages;
  std::vector<std::pair<int, int>> edges;  // transitively reduced, (earlier, later)
};

// True when the two accesses may not run side by side.
bool conflict(const AccessInfo& a, const AccessInfo& b);

// What a graph does with the transient components that can be dropped: keep all of them, or those of one
// chunk a worker, which stay in cache. Their columns then hold whatever a graph that keeps them left.
enum class Transients { kept, dropped };

// How chunk systems become passes. Consecutive ones are one, and a pass joins a later one where no system between
// the two stands in its way; but
//   concurrent   what waits for nothing in the step is a pass of its own: it keeps all threads busy beside the systems
//            that work on the whole world. For chunks that stay in the caches.
//   fewest       nothing is. For chunks that come from memory, each time that they are passed over.
enum class Passes { concurrent, fewest };

// The stages of a list, in order: positions in it.
std::vector<std::vector<std::size_t>> stages_of(const std::vector<System>& systems, Passes passes);

// The transient components that one pass over the chunks writes first and no other system touches.
std::vector<TypeKey> droppable_components(const std::vector<System>& systems,
                                          Passes passes = Passes::concurrent);

class TaskGraph {
 public:
  // `systems` in the order of the step list, `chunks` those that it computes, or how many, from 0. Must be built and run inside the arena it will use; where
  // transients are dropped, those that the world has room for, a chunk's a worker, use it
  // (World::allocate_transient). `world`: whose columns busy systems look ahead to; null: to none.
  TaskGraph(std::vector<System> systems, std::vector<int> chunks, Passes passes = Passes::concurrent,
            Transients transients = Transients::kept, const World* world = nullptr);
  TaskGraph(std::vector<System> systems, int chunks, Passes passes = Passes::concurrent,
            Transients transients = Transients::kept, const World* world = nullptr);
  ~TaskGraph();
  TaskGraph(TaskGraph&&) noexcept;
  TaskGraph& operator=(TaskGraph&&) noexcept;

  // Runs every stage once. An exception of a system ends the run and comes out here.
  void run();
  const GraphPlan& plan() const { return plan_; }
  std::vector<SystemCost> costs() const;  // in the order of the list

 private:
  struct Flow;
  GraphPlan plan_;
  std::unique_ptr<Flow> flow_;
};

// The part of TaskGraph that is data: what `pulvis plan` prints and the tests assert.
GraphPlan derive_plan(const std::vector<System>& systems, Passes passes = Passes::concurrent);

}  // namespace pulvis
