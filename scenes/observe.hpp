// What a scene asks for under [output] beyond forces and energies: its columns and resources, its series
// and fields.
#pragma once

#include <vector>

#include "engine/record.hpp"
#include "engine/world.hpp"
#include "scenes/problem.hpp"
#include "scenes/scene.hpp"
#include "scenes/table_reader.hpp"

namespace pulvis {

// Refuses what cannot be observed of this scene.
void check_output(const Scene& scene, const schema::Origins& origins, Problems& problems);

// Gives a world that has its bodies what the scene asks for.
void add_observed(World& world, const Scene& scene);

// In the order of append_observed_sample and append_observed_frame.
std::vector<SeriesInfo> observed_series(const Scene& scene);
std::vector<FieldInfo> observed_fields(const Scene& scene);

// Of an observed world. `die_area` m^2, between the tools; 0 where no four planes make a die.
void append_observed_sample(const World& world, double die_area, std::vector<double>& row);
void append_observed_frame(const World& world, std::vector<std::vector<double>>& fields);

}  // namespace pulvis
