// Load balancing: decides which chunks each rank owns, from the measured time of its steps.
//
// The cost of a rank is the processor time of its threads per step, excluding time spent waiting for others: the median
// over the steps since the last check. It is split over its chunks by their elements and contact rows. If the slowest
// rank is slower than the mean by more than a tenth, chunks are redistributed by these costs and their current
// positions. Timings decide who computes what, but never change a bit of the result.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "engine/processor_time.hpp"
#include "engine/ranks/ranks.hpp"
#include "engine/world.hpp"

namespace pulvis {

// A migration: chunks that moved to other ranks.
struct Rebalancing {
  std::int64_t step = 0;  // the step it follows
  int chunks = 0;
  double seconds = 0;  // that it took
  // s, own work of every rank per step; `after` is empty if not yet known.
  std::vector<double> before, after;
};

// Slowest rank over the mean, minus 1.
double imbalance_of(const std::vector<double>& seconds);

class Balance {
 public:
  // For every chunk, > 0, in any unit.
  using Costs = std::function<std::vector<double>(std::int64_t step, int chunks)>;

  explicit Balance(World& share);

  // Runs a step and measures its time.
  template <class Step>
  void measure(const Step& step) {
    const double before = own_seconds();
    step();
    own_.push_back(own_seconds() - before);
  }
  // Compares the costs of all ranks. Collective. True if chunks have migrated: the step's graphs must be rebuilt.
  bool divide();
  // Shares the costs since the last check, if there are enough steps; all ranks know them then. Collective.
  void tell_costs();

  // ---- only on the root
  bool is_due() const { return static_cast<std::int64_t>(own_.size()) >= every_ * wait_; }
  // s, own work of every rank per step; empty if not known.
  const std::vector<double>& seconds() const { return seconds_; }
  const std::vector<Rebalancing>& rebalancings() const { return rebalancings_; }
  // Uses `costs` instead of measured times, at this interval of steps, and accepts any gain, however small.
  void follow(std::int64_t every, Costs costs) {
    every_ = every;
    costs_ = std::move(costs);
  }

 private:
  double own_seconds() const { return process_seconds() - ranks_.seconds_waited(); }
  std::vector<int> new_owners(const std::vector<Ranks::Bytes>& told);
  bool pays(const std::vector<double>& cost, const std::vector<int>& owner) const;
  void compare();

  World& share_;
  Ranks& ranks_;
  std::vector<double> own_;  // s, of every step since the last check
  std::vector<double> seconds_;
  std::vector<Rebalancing> rebalancings_;
  bool wants_after_ = false;  // the last rebalancing has no `after` yet
  std::int64_t every_;
  std::int64_t wait_ = 1;  // interval between checks, in multiples of `every_`
  Costs costs_;
};

}  // namespace pulvis
