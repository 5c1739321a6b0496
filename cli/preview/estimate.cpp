#include "cli/preview/estimate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <optional>

#include "scenes/spec/yield.hpp"

namespace pulvis {
namespace {

std::string duration_text(double seconds) {
  if (seconds < 1) return "less than a second";
  if (seconds < 100) return fmt::format("about {:.2g} s", seconds);
  if (seconds < 100 * 60) return fmt::format("about {:.2g} min", seconds / 60);
  return fmt::format("about {:.2g} h", seconds / 3600);
}

// Rounds to two digits, written out: 1234567 is 1,200,000.
std::string rounded(double count) {
  const double unit = count < 100 ? 1 : std::pow(10, std::floor(std::log10(count)) - 1);
  std::string digits = fmt::format("{:.0f}", std::round(count / unit) * unit);
  for (auto at = static_cast<std::ptrdiff_t>(digits.size()) - 3; at > 0; at -= 3)
    digits.insert(static_cast<std::size_t>(at), 1, ',');
  return digits;
}

// How steps get more expensive, and shorter, as a powder gets denser. Measured with shipped scenes (docs/performance.md).
// Densities are relative, above that at the start.
struct Growth {
  double usual;        // -, cost of a step over that at the start, where no density is known
  double more_steps;   // -, over those of the first length: elements get thinner
  double first_touch;  // -, of the cost, once particles touch on all sides
  double touching;     // -, density over which they come to
  double per_density;  // -, of the cost
  double shorter = 0;  // -, of the number of steps, per density
};

bool welds(const Scene& scene) {
  return std::ranges::any_of(
      scene.bonds, [](const BondSpec& bond) { return bond.origin == BondSpec::Origin::pressed; });
}

Growth growth_of(const Scene& scene, std::size_t particles) {
  if (particles == 1) return {1.2, 1.05, 0.2, 0.04, 0};
  // Particles that do not yield are squeezed until their elements are thin.
  if (!any_material_yields(scene)) return {1.1, 1, 0, 1, 45, 11};
  if (scene.in_space()) return {2, 1.15, 0.6, 0.02, 8.5};  // the area in contact grows on and on
  if (welds(scene)) return {2, 1.1, 1.8, 0.04, 0};
  return {1.45, 1.03, 1, 0.04, 0};
}

struct Means {
  double steps = 1, cost = 1;  // over those at the start; `cost` of all these steps
};

// Over a stage in which tools move at constant speed: the inverse of the density changes linearly.
Means means_over(const StageForecast& stage, double at_start, const Growth& growth) {
  constexpr int parts = 20;
  const double from = 1 / *stage.begins, to = 1 / *stage.ends;
  Means means{0, 0};
  for (int i = 0; i < parts; ++i) {
    const double density = 1 / (from + (to - from) * (i + 0.5) / parts);
    const double denser = std::max(density - at_start, 0.0);
    const double steps = 1 + growth.shorter * denser;
    means.steps += steps / parts;
    means.cost += steps / parts *
                  (1 + growth.first_touch * (1 - std::exp(-denser / growth.touching)) +
                   growth.per_density * denser);
  }
  return means;
}

// s, of this process: what else runs on the machine does not count.
double processor_time() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

// s, of one step, measured for long enough to have all that steps do now and then.
double seconds_a_step(Simulation& simulation) {
  constexpr double long_enough = 0.1, too_long = 2;   // s
  constexpr std::int64_t enough = 160, at_once = 32;  // steps; the first of a run may be short
  const double begin = processor_time();
  double taken = 0;
  std::int64_t steps = 0;
  while (!simulation.finished() && taken < too_long && (steps < enough || taken < long_enough)) {
    const std::int64_t block = std::clamp<std::int64_t>(steps, 1, at_once);
    simulation.run_steps(block);
    steps += block;
    taken = processor_time() - begin;
  }
  return steps > 0 ? taken / static_cast<double>(steps) : 0;
}

}  // namespace

RunEstimate estimate_run(Simulation& simulation, const Scene& scene, std::size_t particles,
                         const std::vector<StageForecast>& stages) {
  RunEstimate estimate;
  const double end = simulation.clock().end;
  simulation.run_steps(2);  // first touch of memory, first contact search
  const double of_a_step = seconds_a_step(simulation);
  estimate.dt = simulation.clock().dt;
  const Growth growth = growth_of(scene, particles);
  const std::optional<double> at_start = stages.empty() ? std::nullopt : stages.front().begins;
  double steps = 0, cost = 0;  // s, times how many, or how expensive, they are
  for (const StageForecast& stage : stages) {
    const bool known = at_start && stage.begins && stage.ends && std::isfinite(*stage.ends);
    const Means means = known ? means_over(stage, *at_start, growth) : Means{1, growth.usual};
    steps += stage.duration * means.steps;
    cost += stage.duration * means.cost;
    estimate.is_most = estimate.is_most || !stage.is_known;
  }
  if (stages.empty()) steps = end, cost = end * growth.usual;
  estimate.steps = growth.more_steps * steps / estimate.dt;
  constexpr double beside =
      1.35;  // contact searches, samples, frames and report, which first steps do not have
  estimate.seconds = beside * growth.more_steps * cost / estimate.dt * of_a_step;
  return estimate;
}

std::string estimate_text(const RunEstimate& estimate) {
  return fmt::format(
      "run: {}{} steps of up to {:.2g} s; {} of one processor of this machine (estimated from its "
      "first steps, the densities of its stages, and what contacts have cost in other runs)",
      estimate.is_most ? "at most about " : "about ", rounded(estimate.steps), estimate.dt,
      duration_text(estimate.seconds));
}

}  // namespace pulvis
