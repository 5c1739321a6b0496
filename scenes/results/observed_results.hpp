// Series and fields that a run observes beyond motion and forces.
#pragma once

#include <vector>
#include "engine/files/record.hpp"
#include "engine/world.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

// In the order of append_observed_sample and append_observed_frame.
std::vector<SeriesInfo> observed_series(const Scene& scene);
std::vector<FieldInfo> observed_fields(const Scene& scene);

// From an observed world. `die_area` m^2, between the tools; 0 where no four planes form a die.
void append_observed_sample(const World& world, double die_area, std::vector<double>& row);
void append_observed_frame(const World& world, std::vector<std::vector<double>>& fields);

}  // namespace pulvis
