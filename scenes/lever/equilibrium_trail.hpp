// The last equilibria of a programme, and where they lead: the first guess of the next increment.
//
// Source   extrapolation of equal steps by a parabola. A thin lever's membrane is so much stiffer than its bending
//          that Newton's method needs four iterations and more to turn it by the last increment's angle again
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "systems/lever/static_solver.hpp"

namespace pulvis {

// An increment as it was asked for: of the scanner, m, and of the force to keep, N.
using IncrementStep = std::array<double, 4>;

class EquilibriumTrail {
 public:
  // Nothing where the last increments were others, or too few.
  std::optional<StaticSolver::State> next(const IncrementStep& step) const;
  void add(const StaticSolver::State& reached, const IncrementStep& step);
  void clear() { reached_.clear(); }

  template <class Bytes>
  void state(Bytes& bytes) {
    bytes(step_, reached_);
  }

 private:
  IncrementStep step_{};
  std::vector<StaticSolver::State> reached_;  // three at most, the last one at the end
};

}  // namespace pulvis
