#include "bench/throughput/lines.hpp"

#include <algorithm>
#include <chrono>
#include <map>
#include <span>

#include "components/body.hpp"
#include "systems/step.hpp"

namespace pulvis::bench {
namespace {

using Time = std::chrono::steady_clock;
constexpr int warm_up = 8;  // steps: warms up caches and workers after a change of threads

double since(Time::time_point start) {
  return std::chrono::duration<double>(Time::now() - start).count();
}

std::vector<System> all_systems(World& world) {
  StepList list = step_list(world);
  std::vector<System> all = std::move(list.forces);
  for (System& system : list.motion) all.push_back(std::move(system));
  return all;
}

// The step split into three graphs; only the middle one is timed.
class SplitStep {
 public:
  SplitStep(World& world, std::vector<System> all)
      : first_(position(all, {"trial_stress", "elastic_stress"})),
        last_(position(all, {"internal_force"}) + 1),
        before_(part(all, 0, first_), world.chunks()),
        kernels_(part(all, first_, last_), world.chunks()),
        after_(part(all, last_, all.size()), world.chunks()) {}

  double run() {
    before_.run();
    const auto start = Time::now();
    kernels_.run();
    const double seconds = since(start);
    after_.run();
    return seconds;
  }

 private:
  static std::size_t position(const std::vector<System>& all,
                              const std::vector<std::string>& names) {
    const auto found = std::ranges::find_if(
        all, [&](const System& s) { return std::ranges::find(names, s.name) != names.end(); });
    return static_cast<std::size_t>(found - all.begin());
  }
  static std::vector<System> part(const std::vector<System>& all, std::size_t first,
                                  std::size_t last) {
    return {all.begin() + static_cast<std::ptrdiff_t>(first),
            all.begin() + static_cast<std::ptrdiff_t>(last)};
  }
  std::size_t first_, last_;
  TaskGraph before_, kernels_, after_;
};

// Consecutive systems are fused. Unlike a graph, this does not move world-wide systems out of the way, so data that a
// graph would drop after a pass is kept here.
class TimedSystems {
 public:
  explicit TimedSystems(World& world)
      : chunks_(world.chunks()), systems_(all_systems(world)), seconds_(systems_.size()) {}

  void run() {
    for (std::size_t first = 0, last; first < systems_.size(); first = last) {
      const bool by_chunk = systems_[first].by_chunk;
      for (last = first + 1; by_chunk && last < systems_.size() && systems_[last].by_chunk;) ++last;
      for (int chunk = 0; chunk < (by_chunk ? chunks_ : 1); ++chunk)
        run_fused(first, last, Chunk{chunk});
    }
  }
  std::map<std::string, double> seconds() const {
    std::map<std::string, double> by_name;
    for (std::size_t s = 0; s < systems_.size(); ++s) by_name[systems_[s].name] += seconds_[s];
    return by_name;
  }

 private:
  void run_fused(std::size_t first, std::size_t last, Chunk chunk) {
    auto start = Time::now();
    for (std::size_t s = first; s < last; ++s) {
      systems_[s].run(chunk);
      const auto end = Time::now();
      seconds_[s] += std::chrono::duration<double>(end - start).count();
      start = end;
    }
  }
  int chunks_;
  std::vector<System> systems_;
  std::vector<double> seconds_;
};

struct PlasticPoints {
  std::span<const double> strains;
  int of_element = 0;
};
PlasticPoints plastic_points(const World& world) {
  return with_formulation(world.resource<Bodies>().formulation, [&]<class F>(F) {
    const auto& column = world.column<PlasticStrain<F::points>>();
    return PlasticPoints{{column.values(), column.bytes() / sizeof(double)}, F::points};
  });
}

}  // namespace

double step_seconds(State& state, int threads) {
  double seconds = 0;
  Workers(threads).run([&] {
    Step step(state.world());
    for (int i = 0; i < warm_up; ++i) step.run();
    const auto start = Time::now();
    for (int i = 0; i < state.of().batch; ++i) step.run();
    seconds = since(start);
  });
  return seconds;
}

double kernel_seconds(State& state, int threads) {
  double seconds = 0;
  Workers(threads).run([&] {
    SplitStep step(state.world(), all_systems(state.world()));
    for (int i = 0; i < warm_up; ++i) step.run();
    for (int i = 0; i < state.of().batch; ++i) seconds += step.run();
  });
  return seconds;
}

double graph_seconds(State& state, int threads) {
  double seconds = 0;
  Workers(threads).run([&] {
    std::vector<System> idle = all_systems(state.world());
    for (System& system : idle) system.run = [](Chunk) {};
    TaskGraph graph(std::move(idle), state.world().chunks());
    for (int i = 0; i < warm_up; ++i) graph.run();
    const auto start = Time::now();
    for (int i = 0; i < state.of().batch; ++i) graph.run();
    seconds = since(start);
  });
  return seconds;
}

std::map<std::string, double> system_seconds(State& state) {
  std::map<std::string, double> seconds;
  Workers(1).run([&] {
    TimedSystems step(state.world());
    for (int i = 0; i < state.of().batch; ++i) step.run();
    seconds = step.seconds();
  });
  return seconds;
}

std::vector<std::string> system_names(World& world) {
  std::vector<std::string> names;
  for (const System& system : all_systems(world)) names.push_back(system.name);
  return names;
}

double flowing_share(State& state) {
  const auto [strains, points] = plastic_points(state.world());
  const std::vector<double> before(strains.begin(), strains.end());
  Workers(1).run([&] { Step(state.world()).run(); });
  double flowing = 0;
  for (std::size_t i = 0; i < before.size(); ++i) flowing += strains[i] > before[i] ? 1 : 0;
  return flowing / (points * static_cast<double>(state.elements()));
}

Memory column_bytes(const World& world) {
  Memory memory;
  for (const ColumnBase* column : world.columns()) {
    const bool of_bodies = column->entity == Node::name || column->entity == Element::name ||
                           column->entity == Particle::name;
    (of_bodies ? memory.bodies : memory.contact) += static_cast<double>(column->bytes());
  }
  return memory;
}

double bytes_a_step(World& world) {
  std::map<std::string, double> bytes;
  for (const ColumnBase* column : world.columns())
    bytes[column->entity + "/" + column->info.name] = static_cast<double>(column->bytes());
  const std::vector<System> systems = all_systems(world);
  const std::vector<TypeKey> in_cache = droppable_components(systems);
  double sum = 0;
  for (const StagePlan& stage : derive_plan(systems).stages)
    for (const AccessInfo& access : stage.accesses) {
      const auto column = bytes.find(access.name);
      if (column == bytes.end() || std::ranges::find(in_cache, access.key) != in_cache.end())
        continue;
      sum += column->second * (access.mode == AccessMode::write ? 2 : 1);
    }
  return sum;
}

}  // namespace pulvis::bench
