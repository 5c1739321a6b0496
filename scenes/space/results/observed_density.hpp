// output.density_cells in three dimensions: relative densities in the cells of a grid between the tools.
#pragma once

#include <vector>

#include "engine/files/record.hpp"
#include "engine/world.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis::space {

// Whether the tools enclose a room along whose axes a grid can be aligned.
bool has_grid_room(const Scene& scene);
void add_observed_density(World& world, const Scene& scene);

std::vector<SeriesInfo> density_series(const Scene& scene);
std::vector<FieldInfo> density_fields(const World& world);
void append_density_sample(const World& world, std::vector<double>& row);
void append_density_frame(const World& world, std::vector<std::vector<double>>& fields);

}  // namespace pulvis::space
