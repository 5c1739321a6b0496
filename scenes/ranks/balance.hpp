// Load balance: which chunks each rank owns, by what its steps have taken.
//
// The cost of a rank is the processor time of its threads in a step, without that in which it waits for others: the median
// over the steps since the last look. It is dealt out to its chunks by their elements and contact rows. Where the slowest
// rank is slower than the mean by more than a tenth, chunks are divided anew by these costs and the positions they have by
// now. Times decide who computes what, and no bit of it.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "engine/processor_time.hpp"
#include "engine/ranks/ranks.hpp"
#include "engine/world.hpp"

namespace pulvis {

// A migration: chunks that went to other ranks.
struct Rebalancing {
  std::int64_t step = 0;  // after it
  int chunks = 0;
  double seconds = 0;  // that it took
  // s, own work of every rank in a step; `after` is empty where it is not known yet.
  std::vector<double> before, after;
};

// Of the slowest over the mean.
double imbalance_of(const std::vector<double>& seconds);

class Balance {
 public:
  // Of every chunk, > 0, in any unit.
  using Costs = std::function<std::vector<double>(std::int64_t step, int chunks)>;

  explicit Balance(World& share);

  // Runs a step and takes its time.
  template <class Step>
  void measure(const Step& step) {
    const double before = own_seconds();
    step();
    own_.push_back(own_seconds() - before);
  }
  // Looks at the costs of all ranks. Collective. True where chunks have migrated: the step's graphs have to be made anew.
  bool divide();
  // Of the steps since the last look, where they are enough; known on all ranks then. Collective.
  void tell_costs();

  // ---- of the root
  bool is_due() const { return static_cast<std::int64_t>(own_.size()) >= every_ * wait_; }
  // s, own work of every rank in a step; empty where it is not known.
  const std::vector<double>& seconds() const { return seconds_; }
  const std::vector<Rebalancing>& rebalancings() const { return rebalancings_; }
  // Instead of what steps take, `costs` say it, every so many steps, and no gain is too small.
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
  std::vector<double> own_;  // s, of every step since the last look
  std::vector<double> seconds_;
  std::vector<Rebalancing> rebalancings_;
  bool wants_after_ = false;  // the last of them
  std::int64_t every_;
  std::int64_t wait_ = 1;  // looks that are left out, and one
  Costs costs_;
};

}  // namespace pulvis
