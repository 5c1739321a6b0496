// The uncertainty of a model's results, by sampling all of its inputs, and the contribution of each group of inputs.
//
// Source   propagation of distributions: JCGM 101:2008 (GUM supplement 1), normal distributions; interval between the
//          quantiles with equal tails. Contribution of a group: the variance with only that group sampled, the
//          others at their values (its annex B), over that of all: first-order shares. Their sum differs from one
//          where the model is nonlinear. Also the law of propagation (JCGM 100:2008, 5.1.2) by central differences.
// Draws    SplitMix64 and Box & Muller (1958), one stream per input: a seed gives the same bits everywhere
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cli/laboratory/volts/volts_model.hpp"
#include "scenes/outlines/portable.hpp"

namespace pulvis::volts {

struct Share {
  double drawn = 0;   // -, of the variance, with only this group sampled
  double linear = 0;  // -, of the linear variance
};

struct Quantity {
  std::string name;  // as in summary.json
  std::string unit;
  double value = 0;            // with all inputs at their values
  double mean = 0, error = 0;  // of the draws; one standard deviation
  double linear = 0;           // standard uncertainty by the law of propagation
  double low = 0, high = 0;    // of the interval
  std::vector<Share> shares;   // by group of the model
  std::vector<int> histogram;  // over equal parts of [from, until]
  double from = 0, until = 0;
};

struct MonteCarlo {
  Outcome nominal;
  std::vector<Quantity> quantities;
  int draws = 0, failed = 0;  // failed: draws for which no friction fits
};

struct DrawSpec {
  int draws = 20000;
  std::uint64_t seed = 1;
  double confidence = 0.95;
  bool shares = true;  // contribution of each group: needs as many draws again for each
};

// Throws std::runtime_error where no friction fits the values themselves, or more than one draw in a hundred.
MonteCarlo propagate(const Model& model, const DrawSpec& spec);

// Normal deviates of one input.
class Deviates {
 public:
  Deviates(std::uint64_t seed, std::size_t input);
  double next();

 private:
  portable::Random random_;
  double spare_ = 0;
  bool has_spare_ = false;
};

}  // namespace pulvis::volts
