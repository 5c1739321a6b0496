// The uncertainty of what a model gives, by drawing all of its inputs, and what each group of them contributes.
//
// Source   propagation of distributions: JCGM 101:2008 (GUM supplement 1), normal laws; interval between the
//          quantiles with equal tails. Contribution of a group: the variance with that group alone drawn, the
//          others at their values (its annex B), over that of all: first-order shares. Their sum differs from one
//          by what is not linear. Beside it the law of propagation (JCGM 100:2008, 5.1.2) by central differences.
// Draws    SplitMix64 and Box & Muller (1958), a stream for every input: the same bits for a seed everywhere
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scenes/outlines/portable.hpp"
#include "scenes/volts/volts_model.hpp"

namespace pulvis::volts {

struct Share {
  double drawn = 0;   // -, of the variance, this group alone drawn
  double linear = 0;  // -, of the linear variance
};

struct Quantity {
  std::string name;  // as in summary.json
  std::string unit;
  double value = 0;            // with all inputs at their values
  double mean = 0, error = 0;  // of the draws; one standard deviation
  double linear = 0;           // standard uncertainty by the law of propagation
  double low = 0, high = 0;    // the interval
  std::vector<Share> shares;   // by group of the model
  std::vector<int> histogram;  // of equal parts of [from, until]
  double from = 0, until = 0;
};

struct MonteCarlo {
  Outcome nominal;
  std::vector<Quantity> quantities;
  int draws = 0, failed = 0;  // failed: no friction fitted these
};

struct DrawSpec {
  int draws = 20000;
  std::uint64_t seed = 1;
  double confidence = 0.95;
  bool shares = true;  // what each group contributes: as many draws again for each
};

// Throws std::runtime_error where the values themselves fit no friction, or more than one draw in a hundred fits none.
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
