// The periodic cell of a scene, and a die that is driven in the same way.
#pragma once

#include <vector>

#include "components/cell.hpp"
#include "engine/world.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

// m, one for each dimension of the scene. The height must be known.
std::vector<Vec3> cell_vectors(const CellSpec& cell);
double size_of_cell(const CellSpec& cell);  // m^2 or m^3

// Where the scene has one. `bodies`: the particles.
template <class D>
void add_cell(World& world, const Scene& scene, const std::vector<BodySpec>& bodies);

// Whether stages move the planes of a die by strains or stresses.
bool drives_walls(const Scene& scene);
template <class D>
void add_driven_walls(World& world, const Scene& scene, const std::vector<BodySpec>& bodies);

// Of the cell or the die; null if neither is driven.
const MixedControl* mixed_control_of(const World& world);

}  // namespace pulvis
