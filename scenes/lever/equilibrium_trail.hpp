// The last equilibria of a programme, extrapolated: the initial guess for the next increment.
//
// Source   parabolic extrapolation of equal steps. A thin lever's membrane is so much stiffer than its bending
//          that Newton's method needs four or more iterations just to repeat the rotation of the last increment
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "systems/lever/static_solver.hpp"

namespace pulvis {

// A requested increment: of the scanner, m, and of the force to hold, N.
using IncrementStep = std::array<double, 4>;

class EquilibriumTrail {
 public:
  // Empty where the last increments were different, or too few.
  std::optional<StaticSolver::State> next(const IncrementStep& step) const;
  void add(const StaticSolver::State& reached, const IncrementStep& step);
  void clear() { reached_.clear(); }

  template <class Bytes>
  void state(Bytes& bytes) {
    bytes(step_, reached_);
  }

 private:
  IncrementStep step_{};
  std::vector<StaticSolver::State> reached_;  // at most three, the latest at the end
};

}  // namespace pulvis
