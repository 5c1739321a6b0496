// The task graph of a step, derived from what its systems declare.
//
// Chunk systems are grouped into passes: a pass is one stage, a parallel loop over chunks that runs its systems back to
// back while the chunk is in cache. How they are grouped is the graph's policy (Passes); the step list only defines
// an order. Two stages are connected by an edge, in list order, if they access the same component and one of
// them writes it, or if one of them changes the row count of an entity type that the other accesses. Edges are never
// written by hand. Stages without an edge between them run concurrently.
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
  std::vector<AccessInfo> accesses;  // union over its systems; write takes precedence over read
  std::vector<int>
      taken_before;  // for small tasks: stages with all chunks taken before this one begins
};

// Time spent in a system, summed over all workers. Only every 61st run is timed: this keeps the cost of the clock
// low, and is accurate enough for runs of thousands of steps.
struct SystemCost {
  std::string system;
  double seconds = 0;

  template <class Bytes>
  void state(Bytes& bytes) {
    bytes(system, seconds);
  }
};
// System by system; those of `one` come first.
std::vector<SystemCost> added(std::vector<SystemCost> one, const std::vector<SystemCost>& other);

struct GraphPlan {
  std::vector<StagePlan> stages;
  std::vector<std::pair<int, int>> edges;  // transitively reduced, (earlier, later)
};

// True if the two accesses must not run concurrently.
bool conflict(const AccessInfo& a, const AccessInfo& b);

// How a graph treats transient components that can be dropped: keeps all rows, or only those of one
// chunk per worker, which stay in cache. Their columns then hold whatever a graph that keeps them left there.
enum class Transients { kept, dropped };

// How chunk systems are grouped into passes. Consecutive ones form one pass, and a pass joins a later one unless a
// system between the two prevents it; but
//   concurrent   a pass that depends on nothing in the step stays separate: it keeps all threads busy alongside the
//            systems that work on the whole world. For chunks that stay in the caches.
//   fewest       no pass stays separate. For chunks loaded from memory in every pass.
enum class Passes { concurrent, fewest };

// The stages of a list, in order, as positions in the list.
std::vector<std::vector<std::size_t>> stages_of(const std::vector<System>& systems, Passes passes);

// The transient components that one pass over the chunks writes first and that no other system accesses.
std::vector<TypeKey> droppable_components(const std::vector<System>& systems,
                                          Passes passes = Passes::concurrent);

class TaskGraph {
 public:
  // `systems` in the order of the step list; `chunks`: the chunks to compute, or their number, from 0. Must be built and run in the arena it will use; where
  // transients are dropped, the graph uses the transient columns for which the world has a per-worker chunk buffer
  // (World::allocate_transient). `world`: its columns are prefetched by compute-bound systems; null: no prefetching.
  TaskGraph(std::vector<System> systems, std::vector<int> chunks,
            Passes passes = Passes::concurrent, Transients transients = Transients::kept,
            const World* world = nullptr);
  TaskGraph(std::vector<System> systems, int chunks, Passes passes = Passes::concurrent,
            Transients transients = Transients::kept, const World* world = nullptr);
  ~TaskGraph();
  TaskGraph(TaskGraph&&) noexcept;
  TaskGraph& operator=(TaskGraph&&) noexcept;

  // Runs every stage once. An exception from a system ends the run and is rethrown here.
  void run();
  const GraphPlan& plan() const { return plan_; }
  std::vector<SystemCost> costs() const;  // in list order

 private:
  struct Flow;
  GraphPlan plan_;
  std::unique_ptr<Flow> flow_;
};

// The data part of TaskGraph: what `pulvis plan` prints and the tests check.
GraphPlan derive_plan(const std::vector<System>& systems, Passes passes = Passes::concurrent);

}  // namespace pulvis
