// Throughput of the explicit step, its systems, and the machine it runs on. bench/throughput.py runs
// this program and reads its JSON; docs/performance.md explains the lines.
//
//   throughput [--cases=NAME,...] [--rounds=N] [BENCHMARK OPTION]...
//   throughput --count=NAME:STEPS     no timing: the prepared state and STEPS more, on one thread
//
// A round measures every line once, so that background load affects all of them. Only one case
// at a time is held in memory. Every line has `value`, in the unit given by its label.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <functional>
#include <iostream>
#include <map>
#include <sstream>
#include <thread>

#include "bench/throughput/limit.hpp"
#include "bench/throughput/lines.hpp"
#include "bench/throughput/machine.hpp"
#include "cli/summary.hpp"
#include "engine/instruction_set.hpp"
#include "scenes/build.hpp"
#include "scenes/results/state_hash.hpp"
#include "systems/step.hpp"

namespace pulvis::bench {
namespace {

using benchmark::RegisterBenchmark;

struct Options {
  std::string cases, count;
  int rounds = 1;
};

int processors() { return static_cast<int>(std::max(1U, std::thread::hardware_concurrency())); }

State& state_of(const Case& c) {
  static std::unique_ptr<State> kept;
  if (!kept || &kept->of() != &c) {
    kept.reset();
    kept = std::make_unique<State>(c, processors());
  }
  return *kept;
}

// Result of one line; `seconds` for `updates` element updates if it is a time.
struct Line {
  double value = 0;
  const char* unit = "";
  double seconds = 0, share = 0;
  std::string text = {};  // instead of the unit
};

void add(const std::string& name, const std::function<Line()>& measure) {
  const auto run = [measure](benchmark::State& state) {
    Line line;
    for (auto _ : state) {
      line = measure();
      state.SetIterationTime(line.seconds);
    }
    state.counters["value"] = line.value;
    if (line.share > 0) state.counters["share"] = line.share;
    state.SetLabel(line.text.empty() ? line.unit : line.text);
  };
  RegisterBenchmark(name.c_str(), run)
      ->UseManualTime()
      ->Iterations(1)
      ->Unit(benchmark::kMillisecond);
}

Line time_line(const State& state, double seconds) {
  const double updates =
      static_cast<double>(state.of().batch) * static_cast<double>(state.elements());
  return {1e9 * seconds / updates, "ns/element-step", seconds};
}

// ---- lines ----------------------------------------------------------------------------------------
void add_machine(int threads) {
  const std::string suffix = fmt::format("/threads:{}", threads);
  add("machine/fma" + suffix, [=] { return Line{1e-9 * peak_flops(threads), "GFLOP/s"}; });
  add("machine/triad" + suffix, [=] { return Line{1e-9 * triad_bandwidth(threads), "GB/s"}; });
}

double limit_seconds_of(State& state, int threads) {
  const auto& bodies = state.world().resource<Bodies>();
  return limit_seconds(bodies.shapes.at(0), bodies.particles(), state.of().batch, threads);
}

void add_times(const Case& c, int threads) {
  const auto timed = [&](const char* name, double (*seconds)(State&, int)) {
    add(fmt::format("{}/{}/threads:{}", c.name, name, threads), [&c, seconds, threads] {
      State& state = state_of(c);
      return time_line(state, seconds(state, threads));
    });
  };
  timed("step", step_seconds);
  timed("kernels", kernel_seconds);
  timed("graph", graph_seconds);
  if (has_limit()) timed("limit", limit_seconds_of);
}

// All systems of a round are timed when the first of their lines is measured.
void add_systems(const Case& c, const std::vector<std::string>& names) {
  const auto seconds = std::make_shared<std::map<std::string, double>>();
  for (std::size_t s = 0; s < names.size(); ++s)
    add(fmt::format("{}/system/{}/threads:1", c.name, names[s]), [&c, seconds, s, name = names[s]] {
      State& state = state_of(c);
      if (s == 0 || seconds->empty()) *seconds = system_seconds(state);
      Line line = time_line(state, seconds->at(name));
      double all = 0;
      for (const auto& [system, its] : *seconds) all += its;
      line.share = seconds->at(name) / all;
      return line;
    });
}

void add_memory(const Case& c, double resident_before) {
  const auto per_element = [&c](const char* name, const std::function<double(State&)>& bytes) {
    add(fmt::format("{}/memory/{}", c.name, name), [&c, bytes] {
      State& state = state_of(c);
      return Line{bytes(state) / static_cast<double>(state.elements()), "B/element"};
    });
  };
  per_element("bodies", [](State& s) { return column_bytes(s.world()).bodies; });
  per_element("contact", [](State& s) { return column_bytes(s.world()).contact; });
  per_element("resident", [=](State&) { return resident_bytes() - resident_before; });
  per_element("moved_a_step", [](State& s) { return bytes_a_step(s.world()); });
}

void add_state(const Case& c) {
  add(c.name + "/startup", [&c] { return Line{state_of(c).startup(), "s"}; });
  add(c.name + "/state/flowing", [&c] { return Line{flowing_share(state_of(c)), "1"}; });
  add(c.name + "/state/touching", [&c] {
    State& state = state_of(c);
    const auto rows = static_cast<double>(state.world().resource<Totals>().touching);
    return Line{rows / state.world().resource<Bodies>().particles(), "edges/particle"};
  });
  add(c.name + "/hash", [&c] {
    State& state = state_of(c);
    return Line{static_cast<double>(state.steps()), "", 0, 0, state_hash_text(state.world())};
  });
}

// For the systems required by the scene of the case, without preparing it.
std::vector<std::string> names_of(Case c) {
  if (c.rows > 0) c.rows = c.columns = 2;
  const auto world = build_world(scene_of(c));
  return system_names(*world);
}

bool chosen(const Options& options, const std::string& name) {
  return options.cases.empty() ||
         ("," + options.cases + ",").find("," + name + ",") != std::string::npos;
}

void register_all(const Options& options) {
  const double resident = resident_bytes();
  for (const Case& c : cases()) {
    if (!chosen(options, c.name)) continue;
    const auto names = names_of(c);
    for (int round = 0; round < options.rounds; ++round) {
      for (const int threads : {1, 2}) add_machine(threads);
      for (const int threads : {1, 2}) add_times(c, threads);
      add_systems(c, names);
    }
    add_memory(c, resident);
    add_state(c);
  }
}

// ---- the command line -----------------------------------------------------------------------------
// Removes --NAME=... from the arguments.
std::string take(int& argc, char** argv, const std::string& name) {
  std::string value;
  int kept = 0;
  for (int i = 0; i < argc; ++i) {
    const std::string word = argv[i];
    if (word.starts_with("--" + name + "="))
      value = word.substr(name.size() + 3);
    else
      argv[kept++] = argv[i];
  }
  argc = kept;
  return value;
}

Options options_from(int& argc, char** argv) {
  Options options{take(argc, argv, "cases"), take(argc, argv, "count"), 1};
  const std::string rounds = take(argc, argv, "rounds");
  if (!rounds.empty()) options.rounds = std::stoi(rounds);
  std::istringstream names(options.cases);
  for (std::string name; std::getline(names, name, ',');) case_called(name);  // throws if unknown
  return options;
}

int count(const std::string& what) {
  const std::size_t colon = what.find(':');
  const Case& c = case_called(what.substr(0, colon));
  State state(c, 1);
  Workers(1).run([&] {
    Step step(state.world());
    for (int left = std::stoi(what.substr(colon + 1)); left > 0; --left) step.run();
  });
  fmt::print("elements {} steps {} hash {}\n", state.elements(), state.steps(),
             state_hash_text(state.world()));
  return 0;
}

int run(int argc, char** argv) {
  const Options options = options_from(argc, argv);
  if (!options.count.empty()) return count(options.count);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::AddCustomContext("version", program_version());
  benchmark::AddCustomContext("commit", program_commit());
  benchmark::AddCustomContext("compiler", compiler());
  benchmark::AddCustomContext("instruction_set", instruction_set());
  register_all(options);
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}

}  // namespace
}  // namespace pulvis::bench

int main(int argc, char** argv) try {
  return pulvis::bench::run(argc, argv);
} catch (const std::exception& error) {
  std::cerr << "throughput: " << error.what() << '\n';
  return 2;
}
