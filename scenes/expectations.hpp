// A scene's expectations of its run, compared with the sampled values.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "scenes/results/results.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

struct Verdict {
  std::string what;             // "tool/top/force_y, smallest"
  std::string measured;         // "-0.012 N"
  std::string allowed;          // "at least 0 N"
  std::optional<double> value;  // the measured value, where it is a number
  bool met = false;

  std::string text() const;  // one line
};

class Expectations {
 public:
  explicit Expectations(const Scene& scene) : scene_(scene), values_(scene.expects.size()) {}

  // Looks up a value of the run by name.
  using Lookup = std::function<double(const std::string&)>;

  // Records the series that have expectations; does nothing where the scene expects nothing.
  void sample(double time, const Lookup& value);
  void sample(double time, const Results& results);

  // One verdict for each expectation, preceded by one on the outcome; none where the scene expects
  // nothing. `failure` is what stopped the run, if anything did. Runs the scenes that this one is
  // compared with, until `stop` returns true.
  std::vector<Verdict> judge(const Lookup& figure, double end,
                             const std::optional<std::string>& failure, int threads,
                             const std::function<bool()>& stop = {}) const;
  std::vector<Verdict> judge(const Results& results, const std::optional<std::string>& failure,
                             int threads, const std::function<bool()>& stop = {}) const;

  // The data stored in a checkpoint; the rest comes from the scene.
  template <class Bytes>
  void state(Bytes& bytes) {
    bytes(times_, values_);
  }

 private:
  const Scene& scene_;
  std::vector<double> times_;
  std::vector<std::vector<double>> values_;  // [expectations][samples]
};

bool all_met(const std::vector<Verdict>& verdicts);
// Whether the run, stopped or not, ended as the scene expects.
bool ended_as_expected(const Scene& scene, const std::optional<std::string>& failure);

}  // namespace pulvis
