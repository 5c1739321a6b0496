// Fields of the elements of a world in three dimensions.
#pragma once

#include <vector>

#include "engine/world.hpp"

namespace pulvis::space {

bool is_plastic(const World& world);

// effective_stress, pressure, stress, and plastic_strain where there is any: particles by number, each with its elements.
void append_element_fields(const World& world, std::vector<std::vector<double>>& fields);

}  // namespace pulvis::space
