// Throughput of the explicit step on the compaction of 100 particles, at 3% compression: plastic, with
// contact and friction.
//
//   step/threads:N      the whole step as a run does it. items_per_second = element-updates a second
//   system/<name>       one system of the step, at its place between the others, one thread. The
//                       others keep the state moving and the caches as they are in a run, and only
//                       the named one is timed. share: of the sum of all systems
//   memory              bytes of all columns an element, contact rows included
//   four-point/...      step and systems again with that element formulation
//
// One iteration is a batch of `batch_steps` steps. Repetitions go on from where the last one stopped: the
// punch moves at the shipped scene's speed, so that the state stays plastic and hardly changes.
#include <benchmark/benchmark.h>

#include <chrono>
#include <map>
#include <memory>
#include <numeric>
#include <string>
#include <thread>
#include <vector>

#include "cli/summary.hpp"
#include "components/contact.hpp"
#include "scenes/read.hpp"
#include "scenes/results.hpp"
#include "scenes/simulation.hpp"

namespace pulvis {
namespace {

using Seconds = std::chrono::duration<double>;
using Time = std::chrono::steady_clock;

constexpr int batch_steps = 200;
constexpr double compression = 0.03;  // of the height, before anything is timed

using Formulation = ElementSpec::Formulation;

// The shipped scene with its stage in two: fast to `compression`, then on at the speed it had.
Scene shortened_scene(Formulation formulation) {
  Scene scene = read_scene(PULVIS_SOURCE_DIR "/scenes/compaction/regular-100.toml");
  scene.element.formulation = formulation;
  StageSpec& press = scene.stages.at(0);
  StageSpec rest = press;
  const double height = 2 * 50e-3, depth = std::abs(press.moves.at(0).displacement.y());
  const double speed = depth / press.duration;
  const double before = compression * height;
  press.moves[0].displacement = {0, -before};
  press.duration = before / (3 * speed);
  rest.moves[0].displacement = {0, -(depth - before)};
  rest.moves[0].ramp = 0.01;
  rest.duration = (depth - before) / speed;
  scene.stages.push_back(rest);
  return scene;
}

struct Compaction {
  Compaction(Formulation elements_as, int workers)
      : formulation(elements_as),
        threads(workers),
        scene(shortened_scene(formulation)),
        simulation(scene, threads),
        elements(Results(scene, simulation.world()).elements()) {
    // A little beyond the start of the second stage, where the punch has its speed again.
    simulation.run_until(scene.stages[0].duration + 0.02 * scene.stages[1].duration);
  }
  World& world() { return simulation.world(); }

  Formulation formulation;
  int threads;
  Scene scene;
  Simulation simulation;
  std::int64_t elements;
};

double ns_per_element_step(double seconds, std::int64_t batches, std::int64_t elements) {
  return 1e9 * seconds / static_cast<double>(batches * batch_steps * elements);
}

Compaction& compaction(Formulation formulation, int threads);

// ---- (a) the whole step ---------------------------------------------------------------------------
void whole_step(benchmark::State& state, Formulation formulation) {
  Compaction& c = compaction(formulation, static_cast<int>(state.range(0)));
  double seconds = 0;
  for (auto _ : state) {
    const auto start = Time::now();
    c.simulation.run_steps(batch_steps);
    const double batch = Seconds(Time::now() - start).count();
    state.SetIterationTime(batch);
    seconds += batch;
  }
  state.SetItemsProcessed(state.iterations() * batch_steps * c.elements);
  state.counters["ns_per_element_step"] =
      ns_per_element_step(seconds, state.iterations(), c.elements);
  state.counters["touching_rows"] = static_cast<double>(c.world().resource<Totals>().touching);
}

// ---- (b) system by system -------------------------------------------------------------------------
// Runs batches of steps in the order of the step list, on one thread, and times every system. Systems
// that a run fuses chunk by chunk are fused here too.
class SystemTimes {
 public:
  explicit SystemTimes(Compaction& c) : c_(c), workers_(1) {
    StepList list = step_list(c_.world());
    for (auto* part : {&list.forces, &list.motion})
      for (System& system : *part) systems_.push_back(std::move(system));
  }
  std::int64_t elements() const { return c_.elements; }

  // Seconds of each system in batch `b`; batches are run when first asked for.
  const std::vector<double>& batch(std::size_t b) {
    while (batches_.size() <= b) workers_.run([this] { run_batch(); });
    return batches_[b];
  }

 private:
  void run_batch() {
    seconds_.assign(systems_.size(), 0);
    for (int step = 0; step < batch_steps; ++step) run_step();
    batches_.push_back(seconds_);
  }
  void run_step() {
    for (std::size_t first = 0, last; first < systems_.size(); first = last) {
      for (last = first + 1;
           systems_[first].by_chunk && last < systems_.size() && systems_[last].by_chunk;)
        ++last;
      const int chunks = systems_[first].by_chunk ? c_.world().chunks() : 1;
      for (int chunk = 0; chunk < chunks; ++chunk) run_fused(first, last, Chunk{chunk});
    }
  }
  void run_fused(std::size_t first, std::size_t last, Chunk chunk) {
    auto start = Time::now();
    for (std::size_t s = first; s < last; ++s) {
      systems_[s].run(chunk);
      const auto end = Time::now();
      seconds_[s] += Seconds(end - start).count();
      start = end;
    }
  }

  Compaction& c_;
  Workers workers_;
  std::vector<System> systems_;
  std::vector<double> seconds_;
  std::vector<std::vector<double>> batches_;
};

// One at a time: a simulation limits the threads of the whole program to its own. Kept for the next
// benchmark of the same kind, since compressing takes seconds.
std::unique_ptr<Compaction> kept_compaction;
std::unique_ptr<SystemTimes> kept_times;

Compaction& compaction(Formulation formulation, int threads) {
  if (kept_compaction && kept_compaction->threads == threads &&
      kept_compaction->formulation == formulation)
    return *kept_compaction;
  kept_times.reset();
  kept_compaction.reset();
  kept_compaction = std::make_unique<Compaction>(formulation, threads);
  return *kept_compaction;
}

SystemTimes& system_times(Formulation formulation) {
  Compaction& c = compaction(formulation, 1);
  if (!kept_times) kept_times = std::make_unique<SystemTimes>(c);
  return *kept_times;
}

// Repetition r of every system reads from the same batch r, so that shares add up to one.
void one_system(benchmark::State& state, Formulation formulation, std::size_t system) {
  static std::map<std::pair<Formulation, std::size_t>, std::size_t> repetition;
  const std::vector<double>& seconds =
      system_times(formulation).batch(repetition[{formulation, system}]++);
  for (auto _ : state) state.SetIterationTime(seconds[system]);
  state.counters["ns_per_element_step"] =
      ns_per_element_step(seconds[system], 1, system_times(formulation).elements());
  state.counters["share"] = seconds[system] / std::accumulate(seconds.begin(), seconds.end(), 0.0);
}

// ---- (c) memory -----------------------------------------------------------------------------------
void memory(benchmark::State& state) {
  Compaction& c = compaction(Formulation::one_point, 1);
  double bodies = 0, contact = 0;
  for (auto _ : state) {
    bodies = contact = 0;
    for (const ColumnBase* column : c.world().columns()) {
      const bool of_bodies = column->place == Node::name || column->place == Element::name ||
                             column->place == Particle::name;
      (of_bodies ? bodies : contact) += static_cast<double>(column->bytes());
    }
    state.SetIterationTime(0);
  }
  const double elements = static_cast<double>(c.elements);
  state.counters["bytes_per_element"] = (bodies + contact) / elements;
  state.counters["of_bodies"] = bodies / elements;
  state.counters["of_contact"] = contact / elements;
}

std::string compiler() {
#ifdef __clang__
  return "clang++ " __clang_version__;
#else
  return "g++ " __VERSION__;
#endif
}

void in_batches(benchmark::internal::Benchmark* b, int iterations) {
  b->UseManualTime()->Iterations(iterations)->Unit(benchmark::kMillisecond);
}

void register_formulation(const std::string& prefix, Formulation formulation) {
  for (const int threads : {2, 1})  // one thread last: the systems go on with its state
    in_batches(benchmark::RegisterBenchmark((prefix + "step").c_str(), whole_step, formulation)
                   ->ArgName("threads")
                   ->Arg(threads),
               4);
  // By name from the world that a scene of this kind asks for; nothing is compressed for that.
  Simulation uncompressed(shortened_scene(formulation));
  const StepList list = step_list(uncompressed.world());
  std::size_t s = 0;
  for (const auto* part : {&list.forces, &list.motion})
    for (const System& system : *part)
      in_batches(benchmark::RegisterBenchmark((prefix + "system/" + system.name).c_str(),
                                              one_system, formulation, s++),
                 1);
}

void register_all() {
  register_formulation("", Formulation::one_point);
  in_batches(benchmark::RegisterBenchmark("memory", memory), 1);
  register_formulation("four-point/", Formulation::four_point);
}

}  // namespace
}  // namespace pulvis

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::AddCustomContext("commit", pulvis::program_commit());
  benchmark::AddCustomContext("compiler", pulvis::compiler());
  benchmark::AddCustomContext("threads", "1 and 2 (step/threads:N), 1 (system/...); " +
                                             std::to_string(std::thread::hardware_concurrency()) +
                                             " processors");
  pulvis::register_all();
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  pulvis::kept_times.reset();
  pulvis::kept_compaction.reset();
}
