// How long the stages of a scene will take, and at which relative density the powder comes to rest at their ends, where its file
// alone decides that: prescribed moves in a die, prescribed strains of a cell, and the `until` of a stage.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scenes/spec/scene.hpp"

namespace pulvis {

struct StageForecast {
  double duration = 0;                 // s; its whole time where its end is not known before
  bool is_known = true;                // the duration
  std::optional<double> begins, ends;  // -, relative density
};

std::vector<StageForecast> stage_forecast(const Scene& scene, const std::vector<BodySpec>& bodies);

// "relative density at rest: press 0.95 after 0.7 ms of 1 ms; ..." Empty if no density is known.
std::string stages_text(const Scene& scene, const std::vector<StageForecast>& stages);

}  // namespace pulvis
