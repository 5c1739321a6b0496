#include "engine/task_graph.hpp"

#include <oneapi/tbb/flow_graph.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <numeric>
#include <optional>

#include "engine/deal.hpp"

namespace pulvis {

namespace detail {
void check_chunk_writes(const System& system) {
  for (const AccessInfo& access : system.accesses) {
    const bool writes = access.mode != AccessMode::read;
    if (writes && !access.chunked)
      throw std::logic_error("chunk system '" + system.name + "' may not write '" + access.name +
                             "': it is not divided by chunks");
  }
}
}  // namespace detail

bool conflict(const AccessInfo& a, const AccessInfo& b) {
  if (a.mode == AccessMode::structural || b.mode == AccessMode::structural)
    return a.entity != nullptr && a.entity == b.entity;
  return a.key == b.key && (a.mode == AccessMode::write || b.mode == AccessMode::write);
}

namespace {

void merge_accesses(std::vector<AccessInfo>& into, const std::vector<AccessInfo>& from) {
  for (const AccessInfo& access : from) {
    const auto same = std::ranges::find(into, access.key, &AccessInfo::key);
    if (same == into.end())
      into.push_back(access);
    else if (access.mode != AccessMode::read)
      same->mode = access.mode;
  }
}

bool stages_conflict(const StagePlan& a, const StagePlan& b) {
  return std::ranges::any_of(a.accesses, [&](const AccessInfo& x) {
    return std::ranges::any_of(b.accesses, [&](const AccessInfo& y) { return conflict(x, y); });
  });
}

// Keeps an edge only if no longer path implies it.
std::vector<std::pair<int, int>> reduced_edges(const std::vector<StagePlan>& stages) {
  const int n = static_cast<int>(stages.size());
  std::vector<std::vector<bool>> reach(static_cast<std::size_t>(n),
                                       std::vector<bool>(stages.size()));
  std::vector<std::pair<int, int>> edges;
  for (int later = 0; later < n; ++later)
    for (int earlier = later - 1; earlier >= 0; --earlier) {
      const auto l = static_cast<std::size_t>(later), e = static_cast<std::size_t>(earlier);
      if (reach[l][e] || !stages_conflict(stages[e], stages[l])) continue;
      edges.emplace_back(earlier, later);
      reach[l][e] = true;
      for (std::size_t k = 0; k < e; ++k) reach[l][k] = reach[l][k] || reach[e][k];
    }
  std::ranges::sort(edges);
  return edges;
}

using Stages = std::vector<std::vector<std::size_t>>;  // positions in the list

bool systems_conflict(const System& a, const System& b) {
  return std::ranges::any_of(a.accesses, [&](const AccessInfo& x) {
    return std::ranges::any_of(b.accesses, [&](const AccessInfo& y) { return conflict(x, y); });
  });
}

// For every system: whether it works by chunk, and depends only on such systems.
std::vector<bool> wait_for_nothing(const std::vector<System>& systems) {
  std::vector<bool> free(systems.size());
  for (std::size_t i = 0; i < systems.size(); ++i) {
    free[i] = systems[i].by_chunk;
    for (std::size_t k = 0; k < i && free[i]; ++k)
      free[i] = free[k] || !systems_conflict(systems[k], systems[i]);
  }
  return free;
}

// Consecutive chunk systems form one pass; those of `apart`, which depend on nothing, come before the others.
Stages consecutive(const std::vector<System>& systems, const std::vector<bool>& apart) {
  Stages stages;
  std::size_t i = 0;
  while (i < systems.size()) {
    std::vector<std::size_t> first, rest;
    do (apart[i] ? first : rest).push_back(i);
    while (systems[i++].by_chunk && i < systems.size() && systems[i].by_chunk);
    if (!first.empty()) stages.push_back(std::move(first));
    if (!rest.empty()) stages.push_back(std::move(rest));
  }
  return stages;
}

// Where the pass `from` can continue: the next pass, unless a stage between the two must come after the first
// and before the second. None: the number of stages.
std::size_t next_pass(const std::vector<System>& systems, const Stages& stages, std::size_t from) {
  std::size_t next = from + 1;
  for (; next < stages.size() && !systems[stages[next].front()].by_chunk; ++next)
    for (const std::size_t i : stages[from])
      if (systems_conflict(systems[i], systems[stages[next].front()])) return stages.size();
  return next;
}

}  // namespace

Stages stages_of(const std::vector<System>& systems, Passes passes) {
  std::vector<bool> apart(systems.size());
  if (passes == Passes::concurrent) apart = wait_for_nothing(systems);
  Stages stages = consecutive(systems, apart);
  for (std::size_t s = stages.size(); s-- > 0;) {
    if (!systems[stages[s].front()].by_chunk || apart[stages[s].front()]) continue;
    const std::size_t next = next_pass(systems, stages, s);
    if (next == stages.size()) continue;
    stages[next].insert(stages[next].begin(), stages[s].begin(), stages[s].end());
    stages.erase(stages.begin() + static_cast<std::ptrdiff_t>(s));
  }
  return stages;
}

namespace {

bool waits_for(const GraphPlan& plan, int later, int earlier) {
  return std::ranges::any_of(plan.edges, [&](const auto& edge) {
    return edge.second == later && (edge.first == earlier || waits_for(plan, edge.first, earlier));
  });
}

// The stages whose chunks are all taken before `stage` begins, and which may still be computing then: they can
// start with the step, and whatever depends on them also depends on `stage`.
std::vector<int> stages_taken_before(const GraphPlan& plan, int stage) {
  std::vector<int> found;
  for (int s = 0; s < static_cast<int>(plan.stages.size()); ++s) {
    const bool alone = std::ranges::none_of(plan.edges, [&](const auto& edge) {
      return edge.second == s || (edge.first == s && !waits_for(plan, edge.second, stage));
    });
    if (alone && plan.stages[static_cast<std::size_t>(s)].by_chunk) found.push_back(s);
  }
  return found;
}

}  // namespace

GraphPlan derive_plan(const std::vector<System>& systems, Passes passes) {
  GraphPlan plan;
  const Stages stages = stages_of(systems, passes);
  for (const auto& members : stages) {
    StagePlan stage;
    stage.by_chunk = systems[members.front()].by_chunk;
    for (const std::size_t i : members) {
      stage.systems.push_back(systems[i].name);
      merge_accesses(stage.accesses, systems[i].accesses);
    }
    plan.stages.push_back(std::move(stage));
  }
  plan.edges = reduced_edges(plan.stages);
  for (std::size_t s = 0; s < stages.size(); ++s)
    if (systems[stages[s].front()].small_tasks)
      plan.stages[s].taken_before = stages_taken_before(plan, static_cast<int>(s));
  return plan;
}

std::vector<TypeKey> droppable_components(const std::vector<System>& systems, Passes passes) {
  struct Use {
    TypeKey key;
    std::size_t stage;
    bool droppable;  // first written by a pass over the chunks, and accessed by no other
  };
  std::vector<Use> uses;
  const Stages stages = stages_of(systems, passes);
  for (std::size_t s = 0; s < stages.size(); ++s)
    for (const std::size_t i : stages[s])
      for (const AccessInfo& access : systems[i].accesses) {
        if (!access.transient) continue;
        const auto known = std::ranges::find(uses, access.key, &Use::key);
        if (known == uses.end())
          uses.push_back({access.key, s, systems[i].by_chunk && access.mode == AccessMode::write});
        else if (known->stage != s)
          known->droppable = false;
      }
  std::vector<TypeKey> keys;
  for (const Use& use : uses)
    if (use.droppable) keys.push_back(use.key);
  return keys;
}

namespace {

// What the first compute-bound system of a stage and those after it prefetch: columns that later systems access
// first, and for the next chunk those accessed earlier.
struct ColumnsAhead {
  std::vector<const ColumnBase*> of_this, of_next;

  LookAhead list(const std::vector<int>& chunks, int piece) const {
    LookAhead ahead;
    const auto i = static_cast<std::size_t>(piece);
    for (const ColumnBase* column : of_this) ahead.add(column->of_chunk(chunks[i]));
    if (i + 1 < chunks.size())
      for (const ColumnBase* column : of_next) ahead.add(column->of_chunk(chunks[i + 1]));
    return ahead;
  }
};

ColumnsAhead columns_ahead(const std::vector<const System*>& members, const World* world) {
  ColumnsAhead ahead;
  const auto busy = std::ranges::find(members, true, &System::busy);
  if (world == nullptr || busy == members.end()) return ahead;
  std::vector<TypeKey> met;
  for (auto member = members.begin(); member != members.end(); ++member)
    for (const AccessInfo& access : (*member)->accesses) {
      const ColumnBase* column = access.transient ? nullptr : world->find(access.key);
      if (column == nullptr || std::ranges::find(met, access.key) != met.end()) continue;
      met.push_back(access.key);
      (member > busy ? ahead.of_this : ahead.of_next).push_back(column);
    }
  return ahead;
}

}  // namespace

struct TaskGraph::Flow {
  using Node = tbb::flow::continue_node<tbb::flow::continue_msg>;

  using Time = std::chrono::steady_clock;
  // A prime: what systems do every eighth run is timed as often as it happens. Skips runs with cold caches.
  static constexpr std::int64_t timed_every = 61, timed_first = 4;

  struct alignas(64) Times {      // of one worker; in separate cache lines
    std::vector<double> seconds;  // of each system, in the timed runs
  };

  struct Stage {
    std::vector<std::size_t> systems;
    bool by_chunk;
    ColumnsAhead ahead;
    Deal deal;
    std::vector<Stage*> first;  // stages whose chunks are taken before this one begins
  };

  bool timed() const { return runs % timed_every == timed_first; }

  void run(std::size_t system, const Chunk& chunk) {
    if (!timed()) return systems[system].run(chunk);
    const auto began = Time::now();
    systems[system].run(chunk);
    const auto worker = static_cast<std::size_t>(tbb::this_task_arena::current_thread_index());
    times[worker].seconds[system] += std::chrono::duration<double>(Time::now() - began).count();
  }

  void run_chunk(const Stage& stage, int piece) {
    LookAhead list = stage.ahead.list(chunks, piece);
    const Chunk chunk{chunks[static_cast<std::size_t>(piece)],
                      tbb::this_task_arena::current_thread_index(), list.empty() ? nullptr : &list,
                      drops};
    for (const std::size_t system : stage.systems) run(system, chunk);
  }

  void run_stage(Stage& stage) {
    if (stage.by_chunk) return for_pieces(stage.deal, [&](int piece) { run_chunk(stage, piece); });
    for (Stage* other : stage.first)
      while (const std::optional<int> piece = other->deal.take()) run_chunk(*other, *piece);
    run(stage.systems.front(), Chunk{});
  }

  std::vector<System> systems;
  std::vector<int> chunks;
  bool drops = false;  // transient components
  std::vector<std::unique_ptr<Stage>> stages;
  std::int64_t runs = 0;
  std::vector<Times> times;
  tbb::flow::graph graph;
  std::optional<tbb::flow::broadcast_node<tbb::flow::continue_msg>> start;
  std::vector<std::unique_ptr<Node>> nodes;
};

namespace {

std::vector<int> first_chunks(int count) {
  std::vector<int> all(static_cast<std::size_t>(count));
  std::iota(all.begin(), all.end(), 0);
  return all;
}

}  // namespace

TaskGraph::TaskGraph(std::vector<System> systems, int chunks, Passes passes, Transients transients,
                     const World* world)
    : TaskGraph(std::move(systems), first_chunks(chunks), passes, transients, world) {}

TaskGraph::TaskGraph(std::vector<System> systems, std::vector<int> chunks, Passes passes,
                     Transients transients, const World* world)
    : plan_(derive_plan(systems, passes)), flow_(std::make_unique<Flow>()) {
  flow_->systems = std::move(systems);
  flow_->chunks = std::move(chunks);
  flow_->times.assign(static_cast<std::size_t>(tbb::this_task_arena::max_concurrency()),
                      {std::vector<double>(flow_->systems.size())});
  flow_->drops = transients == Transients::dropped;
  const Stages stages = stages_of(flow_->systems, passes);
  for (std::size_t s = 0; s < stages.size(); ++s) {
    std::vector<const System*> members;
    for (const std::size_t i : stages[s]) members.push_back(&flow_->systems[i]);
    flow_->stages.push_back(std::make_unique<Flow::Stage>(Flow::Stage{
        stages[s],
        plan_.stages[s].by_chunk,
        columns_ahead(members, world),
        Deal(static_cast<int>(flow_->chunks.size()), tbb::this_task_arena::max_concurrency()),
        {}}));
    flow_->nodes.push_back(std::make_unique<Flow::Node>(
        flow_->graph, [flow = flow_.get(), stage = flow_->stages.back().get()](
                          tbb::flow::continue_msg) { flow->run_stage(*stage); }));
  }
  for (std::size_t s = 0; s < stages.size(); ++s)
    for (const int other : plan_.stages[s].taken_before)
      flow_->stages[s]->first.push_back(flow_->stages[static_cast<std::size_t>(other)].get());
  flow_->start.emplace(flow_->graph);
  std::vector<bool> has_predecessor(stages.size());
  for (const auto& [earlier, later] : plan_.edges) {
    const auto e = static_cast<std::size_t>(earlier), l = static_cast<std::size_t>(later);
    tbb::flow::make_edge(*flow_->nodes[e], *flow_->nodes[l]);
    has_predecessor[l] = true;
  }
  for (std::size_t s = 0; s < stages.size(); ++s)
    if (!has_predecessor[s]) tbb::flow::make_edge(*flow_->start, *flow_->nodes[s]);
}

TaskGraph::~TaskGraph() = default;
TaskGraph::TaskGraph(TaskGraph&&) noexcept = default;
TaskGraph& TaskGraph::operator=(TaskGraph&&) noexcept = default;

void TaskGraph::run() {
  for (const auto& stage : flow_->stages) stage->deal.restart();
  flow_->start->try_put(tbb::flow::continue_msg{});
  flow_->graph.wait_for_all();
  ++flow_->runs;
}

std::vector<SystemCost> added(std::vector<SystemCost> one, const std::vector<SystemCost>& other) {
  for (const SystemCost& cost : other) {
    const auto same = std::ranges::find(one, cost.system, &SystemCost::system);
    same == one.end() ? one.push_back(cost) : void(same->seconds += cost.seconds);
  }
  return one;
}

std::vector<SystemCost> TaskGraph::costs() const {
  const std::int64_t every = Flow::timed_every;
  const std::int64_t timed = (flow_->runs + every - 1 - Flow::timed_first) / every;
  const double whole =
      timed > 0 ? static_cast<double>(flow_->runs) / static_cast<double>(timed) : 0;
  std::vector<SystemCost> costs;
  for (std::size_t i = 0; i < flow_->systems.size(); ++i) {
    double seconds = 0;
    for (const Flow::Times& worker : flow_->times) seconds += worker.seconds[i];
    costs.push_back({flow_->systems[i].name, seconds * whole});
  }
  return costs;
}

}  // namespace pulvis
