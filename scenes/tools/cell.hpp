// The periodic cell of a scene, and a die that is driven in the same way.
#pragma once

#include <array>
#include <vector>

#include "engine/world.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

// m, first and second.
std::array<Vec2, 2> cell_vectors(const CellSpec& cell);

// Where the scene has one. `bodies`: the particles.
void add_cell(World& world, const Scene& scene, const std::vector<BodySpec>& bodies);

// Whether stages move the four planes of a die by strains or stresses.
bool drives_walls(const Scene& scene);
void add_driven_walls(World& world, const Scene& scene, const std::vector<BodySpec>& bodies);

}  // namespace pulvis
