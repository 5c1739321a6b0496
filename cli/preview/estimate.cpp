#include "cli/preview/estimate.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>

namespace pulvis {
namespace {

std::string duration_text(double seconds) {
  if (seconds < 1) return "a second or more";
  if (seconds < 100) return fmt::format("at least {:.2g} s", seconds);
  if (seconds < 100 * 60) return fmt::format("at least {:.2g} min", seconds / 60);
  return fmt::format("at least {:.2g} h", seconds / 3600);
}

// Rounds to two digits, written out: 1234567 is 1,200,000.
std::string rounded(double count) {
  const double unit = count < 100 ? 1 : std::pow(10, std::floor(std::log10(count)) - 1);
  std::string digits = fmt::format("{:.0f}", std::round(count / unit) * unit);
  for (auto at = static_cast<std::ptrdiff_t>(digits.size()) - 3; at > 0; at -= 3)
    digits.insert(static_cast<std::size_t>(at), 1, ',');
  return digits;
}

}  // namespace

RunEstimate estimate_run(Simulation& simulation) {
  using Time = std::chrono::steady_clock;
  constexpr double long_enough = 0.02;  // s
  RunEstimate estimate;
  simulation.run_steps(2);  // first touch of memory, first contact search
  estimate.dt = simulation.clock().dt;
  estimate.steps = simulation.clock().end / estimate.dt;
  const Time::time_point begin = Time::now();
  double taken = 0;
  std::int64_t steps = 0;
  for (std::int64_t block = 1; taken < long_enough && !simulation.finished(); block *= 2) {
    simulation.run_steps(block);
    steps += block;
    taken = std::chrono::duration<double>(Time::now() - begin).count();
  }
  estimate.seconds = steps > 0 ? taken / static_cast<double>(steps) * estimate.steps : taken;
  return estimate;
}

std::string estimate_text(const RunEstimate& estimate) {
  return fmt::format(
      "run: at least {} steps of up to {:.2g} s; {} on one thread of this machine (estimated from "
      "its first steps; they get shorter and more expensive as elements are flattened and contacts "
      "form: a dense compact takes several times as many steps, and longer for each)",
      rounded(estimate.steps), estimate.dt, duration_text(estimate.seconds));
}

}  // namespace pulvis
