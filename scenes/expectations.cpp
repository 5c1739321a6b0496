#include "scenes/expectations.hpp"

#include <fmt/format.h>
#include <re2/re2.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "engine/enum_table.hpp"
#include "engine/run_failure.hpp"
#include "scenes/checks/expect_checks.hpp"
#include "scenes/read.hpp"
#include "scenes/results/timetable.hpp"
#include "scenes/scene_files.hpp"
#include "scenes/simulation.hpp"

namespace pulvis {
namespace {

using When = ExpectSpec::When;
using Values = std::vector<double>;

When when_of(const ExpectSpec& expect) {
  return expect.when.value_or(expect.like.empty() ? When::end : When::always);
}

// "-0.012 N"; a bare number if the series has no unit.
std::string with_unit(double value, const std::string& unit) {
  return unit.empty() ? fmt::format("{:.6g}", value) : fmt::format("{:.6g} {}", value, unit);
}

std::string unit_of(const std::vector<SeriesInfo>& all, const std::string& name) {
  for (const SeriesInfo& series : all)
    if (series.name == name && series.unit != "-") return series.unit;
  return "";
}

std::string what_of(const ExpectSpec& expect) {
  static constexpr EnumTable<ExpectSpec::When> words{
      "at the end", "always", "largest", "smallest", "mean", "largest minus smallest"};
  std::string text = expect.series;
  if (!is_figure_of_a_run(expect.series)) text += fmt::format(", {}", words[when_of(expect)]);
  if (expect.from || expect.until)
    text += fmt::format(" from {:g} to {:g} of the run", expect.from.value_or(0),
                        expect.until.value_or(1));
  return text;
}

std::string allowed_of(const ExpectSpec& expect, const std::string& unit) {
  const double within = expect.within.value_or(0);
  const std::string other = name_before_copying(expect.like);
  if (!other.empty() && expect.scale != 1)
    return fmt::format("within {:g} of {:g} times the value of {}", within, expect.scale, other);
  if (!other.empty()) return fmt::format("within {:g} of the value of {}", within, other);
  if (expect.equals && expect.equals->number == 0) return "0 within " + with_unit(within, unit);
  if (expect.equals)
    return fmt::format("{} within {:g} of it", with_unit(expect.equals->number, unit), within);
  std::string text;
  if (expect.above) text = "at least " + with_unit(expect.above->number, unit);
  if (expect.above && expect.below) text += ", ";
  if (expect.below) text += "at most " + with_unit(expect.below->number, unit);
  return text;
}

// How far a value is outside the allowed range; <= 0: inside. NaN stays NaN.
double excess(const ExpectSpec& expect, double value) {
  if (expect.equals) {
    const double equals = expect.equals->number;
    return std::abs(value - equals) - *expect.within * (equals == 0 ? 1 : std::abs(equals));
  }
  double worst = value * 0 - std::numeric_limits<double>::max();
  if (expect.above) worst = std::max(worst, expect.above->number - value);
  if (expect.below) worst = std::max(worst, value - expect.below->number);
  return worst;
}

// The sample selected by `when`; for "always", the one farthest outside the allowed range.
double chosen(const ExpectSpec& expect, const Values& values) {
  for (const double value : values)
    if (std::isnan(value)) return value;
  double sum = 0;
  switch (when_of(expect)) {
    case When::end:
      return values.back();
    case When::max:
      return std::ranges::max(values);
    case When::min:
      return std::ranges::min(values);
    case When::mean:
      for (const double value : values) sum += value;
      return sum / static_cast<double>(values.size());
    case When::range:
      return std::ranges::max(values) - std::ranges::min(values);
    case When::always:
      return *std::ranges::max_element(values, {},
                                       [&](double value) { return excess(expect, value); });
  }
  return values.back();
}

// The samples within the expectation's part of the run.
Values window(const ExpectSpec& expect, const Values& times, const Values& values, double end) {
  Values inside;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (times[i] >= expect.from.value_or(0) * end && times[i] <= expect.until.value_or(1) * end)
      inside.push_back(values[i]);
  return inside;
}

// Another scene, run in memory: the resulting series.
struct OtherRun {
  Values times;
  double end = 0;
  std::map<std::string, Values> series;
  std::string failure;
};

double value_of(const std::string& name, const Scene& scene, const Results& results) {
  const std::vector<SeriesInfo> momentum = momentum_series(scene);
  for (std::size_t i = 0; i < momentum.size(); ++i)
    if (name == momentum[i].name) return results.momentum()[i];
  if (name == "energy_balance_error") return results.energy_balance_error();
  if (name == "kinetic_ratio") return results.kinetic_ratio();
  return results.value(name);
}

OtherRun run_other(const Scene& scene, const std::set<std::string>& names, const OutputSpec& output,
                   int threads, const std::function<bool()>& stop) {
  OtherRun run;
  Simulation simulation(scene, threads);
  Results results(scene, simulation.world());
  const Clock& clock = simulation.clock();
  run.end = clock.end;
  Timetable samples(clock.end, std::max(output.samples, output.frames));
  Timetable frames(clock.end, output.frames);
  try {
    while (!(stop && stop())) {
      if (samples.due(clock.time) || frames.due(clock.time)) {
        simulation.observe();
        results.sample();
        run.times.push_back(clock.time);
        for (const std::string& name : names)
          if (!is_figure_of_a_run(name)) run.series[name].push_back(value_of(name, scene, results));
        samples.pass(clock.time);
        frames.pass(clock.time);
      }
      if (simulation.finished()) break;
      simulation.move();
      simulation.run_until(std::min(samples.next(), frames.next()), stop);
    }
  } catch (const RunFailure& failure) {
    run.failure = failure.what();
  }
  for (const std::string& name : names)
    if (is_figure_of_a_run(name)) run.series[name] = {value_of(name, scene, results)};
  return run;
}

// Largest difference over the largest value of the other scene's series; infinite if nothing can
// be compared, or a sample has a value in only one run. Samples without a value in both runs are equal.
double deviation(const ExpectSpec& expect, const Values& here, const Values& other) {
  constexpr double incomparable = std::numeric_limits<double>::infinity();
  if (here.empty() || here.size() != other.size()) return incomparable;
  const bool last = when_of(expect) == When::end;
  double largest = 0, difference = 0;
  for (std::size_t i = 0; i < here.size(); ++i) {
    const double wanted = expect.scale * other[i];
    if (!std::isnan(wanted)) largest = std::max(largest, std::abs(wanted));
    if (last && i + 1 != here.size()) continue;
    if (std::isnan(here[i]) && std::isnan(wanted)) continue;
    if (std::isnan(here[i]) || std::isnan(wanted)) return incomparable;
    difference = std::max(difference, std::abs(here[i] - wanted));
  }
  return difference == 0 ? 0 : difference / largest;
}

std::string measured_deviation(const Values& here, const Values& other, double deviation) {
  if (here.size() != other.size())
    return fmt::format("{} samples against {}", here.size(), other.size());
  if (std::isinf(deviation)) return "some samples have a value in one run only";
  return fmt::format("off by {:.4g}", deviation);
}

Verdict compare(const ExpectSpec& expect, const Values& here, const OtherRun& other) {
  Verdict verdict{what_of(expect), "", allowed_of(expect, ""), {}, false};
  if (!other.failure.empty()) {
    verdict.measured = "the other run failed: " + other.failure;
    return verdict;
  }
  const bool figure = is_figure_of_a_run(expect.series);
  const Values& all = other.series.at(expect.series);
  const Values there = figure ? all : window(expect, other.times, all, other.end);
  verdict.value = deviation(expect, here, there);
  verdict.measured = measured_deviation(here, there, *verdict.value);
  verdict.met = *verdict.value <= *expect.within;
  return verdict;
}

Verdict hold_against(const ExpectSpec& expect, const Values& values, const std::string& unit) {
  Verdict verdict{what_of(expect), "no sample", allowed_of(expect, unit), {}, false};
  if (values.empty()) return verdict;
  verdict.value = chosen(expect, values);
  verdict.measured = with_unit(*verdict.value, unit);
  verdict.met = excess(expect, *verdict.value) <= 0;
  return verdict;
}

const ExpectSpec* stop_of(const Scene& scene) {
  const auto found = std::ranges::find(scene.expects, true, &ExpectSpec::stops);
  return found == scene.expects.end() ? nullptr : &*found;
}

Verdict outcome_of(const Scene& scene, const std::optional<std::string>& failure) {
  const ExpectSpec* stop = stop_of(scene);
  return {"outcome",
          failure ? "stopped: " + *failure : "reached its end",
          stop == nullptr ? "reaches its end"
                          : fmt::format("stops with the message '{}'", stop->message),
          {},
          ended_as_expected(scene, failure)};
}

}  // namespace

std::string Verdict::text() const {
  return fmt::format("{:<7}  {}: {}; expected: {}", met ? "met" : "NOT met", what, measured,
                     allowed);
}

bool all_met(const std::vector<Verdict>& verdicts) {
  return std::ranges::all_of(verdicts, &Verdict::met);
}

bool ended_as_expected(const Scene& scene, const std::optional<std::string>& failure) {
  const ExpectSpec* stop = stop_of(scene);
  if (stop == nullptr || !failure) return stop == nullptr && !failure;
  // Linear time in the message length, whatever the expression.
  return re2::RE2::PartialMatch(*failure, re2::RE2(stop->message, re2::RE2::Quiet));
}

void Expectations::sample(double time, const Results& results) {
  sample(time, [&](const std::string& series) { return value_of(series, scene_, results); });
}

void Expectations::sample(double time, const Lookup& value) {
  if (scene_.expects.empty()) return;
  times_.push_back(time);
  for (std::size_t i = 0; i < scene_.expects.size(); ++i) {
    const std::string& series = scene_.expects[i].series;
    if (!series.empty() && !is_figure_of_a_run(series)) values_[i].push_back(value(series));
  }
}

std::vector<Verdict> Expectations::judge(const Results& results,
                                         const std::optional<std::string>& failure, int threads,
                                         const std::function<bool()>& stop) const {
  return judge([&](const std::string& name) { return value_of(name, scene_, results); },
               results.end_time(), failure, threads, stop);
}

std::vector<Verdict> Expectations::judge(const Lookup& figure, double end,
                                         const std::optional<std::string>& failure, int threads,
                                         const std::function<bool()>& stop) const {
  std::vector<Verdict> verdicts;
  if (scene_.expects.empty()) return verdicts;
  verdicts.push_back(outcome_of(scene_, failure));
  const std::vector<SeriesInfo> series = expectable_series(scene_);
  std::map<std::filesystem::path, std::set<std::string>> wanted;
  for (const ExpectSpec& expect : scene_.expects)
    if (!expect.like.empty()) wanted[other_scene(scene_, expect)].insert(expect.series);
  std::map<std::filesystem::path, OtherRun> others;
  for (const auto& [file, names] : wanted)
    others[file] = run_other(read_scene_alone(file), names, scene_.output, threads, stop);
  for (std::size_t i = 0; i < scene_.expects.size(); ++i) {
    const ExpectSpec& expect = scene_.expects[i];
    if (expect.stops) continue;
    const Values here = is_figure_of_a_run(expect.series) ? Values{figure(expect.series)}
                                                          : window(expect, times_, values_[i], end);
    verdicts.push_back(expect.like.empty()
                           ? hold_against(expect, here, unit_of(series, expect.series))
                           : compare(expect, here, others.at(other_scene(scene_, expect))));
  }
  return verdicts;
}

}  // namespace pulvis
