#include "scenes/lever/equilibrium_trail.hpp"

#include <cmath>

namespace pulvis {
namespace {

constexpr std::size_t most = 3;

bool same_step(const IncrementStep& a, const IncrementStep& b) {
  constexpr double round_off = 1e-9;
  for (std::size_t k = 0; k < a.size(); ++k)
    if (std::abs(a[k] - b[k]) > round_off * std::max(std::abs(a[k]), std::abs(b[k]))) return false;
  return true;
}

// A line through two states, a parabola through three.
template <class At>
double extrapolated(std::size_t count, const At& at) {
  return count == 2 ? 2 * at(1) - at(0) : 3 * (at(2) - at(1)) + at(0);
}

}  // namespace

std::optional<StaticSolver::State> EquilibriumTrail::next(const IncrementStep& step) const {
  const std::size_t count = reached_.size();
  if (count < 2 || !same_step(step, step_)) return {};
  StaticSolver::State next = reached_.back();
  for (std::size_t i = 0; i < next.displacement.size(); ++i)
    next.displacement[i] =
        extrapolated(count, [&](std::size_t n) { return reached_[n].displacement[i]; });
  for (std::size_t i = 0; i < next.force.size(); ++i)
    next.force[i] = extrapolated(count, [&](std::size_t n) { return reached_[n].force[i]; });
  next.height = extrapolated(count, [&](std::size_t n) { return reached_[n].height; });
  return next;
}

void EquilibriumTrail::add(const StaticSolver::State& reached, const IncrementStep& step) {
  if (!same_step(step, step_)) reached_.clear();
  step_ = step;
  reached_.push_back(reached);
  if (reached_.size() > most) reached_.erase(reached_.begin());
}

}  // namespace pulvis
