// What sets the time step, in words; and what set it in a run: at its first sample, where the stable step was the shortest (to
// 2%), and at its last one.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "scenes/spec/scene.hpp"
#include "systems/time_step_limit.hpp"

namespace pulvis {

// "7.2e-08 s, set by element 33 of particle 12 (powder) ...". `safety`: share of the stable step; `axes`: 2 or 3.
std::string time_step_text(const TimeStepLimit& limit, double safety, int axes);

// "the step of the elements alone would be 1.07 times as long without the 1% with the shortest ones, ...".
std::string slowest_elements_text(const TimeStepLimit& limit);

class StepLimits {
 public:
  // At a sample; `last`: of the run. Of several ranks none knows all particles: they keep nothing.
  void sample(World& world, bool last);
  // One object for each of these samples.
  nlohmann::ordered_json json(const Scene& scene) const;

  template <class Bytes>
  void state(Bytes& bytes) {
    bytes(first_, shortest_, last_);
  }

 private:
  std::optional<TimeStepLimit> first_, shortest_, last_;
};

}  // namespace pulvis
