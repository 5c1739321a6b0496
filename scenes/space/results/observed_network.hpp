// output.contacts in three dimensions: the contact network and its global measures.
#pragma once

#include <vector>

#include "engine/files/record.hpp"
#include "engine/world.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis::space {

void add_observed_network(World& world, const Scene& scene);

std::vector<SeriesInfo> network_series(const Scene& scene);
std::vector<FieldInfo> network_fields(const World& world);
void append_network_sample(const World& world, std::vector<double>& row);
void append_network_frame(const World& world, std::vector<std::vector<double>>& fields);

}  // namespace pulvis::space
