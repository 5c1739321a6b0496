// output.particle_stress in three dimensions: mean stresses of the particles, and of the compact.
#pragma once

#include <vector>

#include "engine/files/record.hpp"
#include "engine/world.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis::space {

// Adds its columns to a world that already has its particles.
void add_observed_stress(World& world, const Scene& scene);

std::vector<SeriesInfo> stress_series(
    const Scene& scene);  // none without a room to refer to
std::vector<FieldInfo> stress_fields(const World& world);
// `room`: m^3, between the tools.
void append_stress_sample(const World& world, double room, std::vector<double>& row);
void append_stress_frame(const World& world, std::vector<std::vector<double>>& fields);

}  // namespace pulvis::space
