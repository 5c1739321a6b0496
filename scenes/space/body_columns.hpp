// The deformable bodies of a world in three dimensions: tables and columns, and their initial values.
#pragma once

#include <optional>
#include <random>
#include <vector>

#include "components/shape.hpp"
#include "components/space/shape.hpp"
#include "engine/world.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis::space {

// One particle in its lane.
struct Placed {
  const BodySpec* body = nullptr;
  Rotation turn = Rotation::Identity();  // from the frame of its mesh to the scene's
};

// Uniform over all rotations (Shoemake 1992), identical on every machine.
Rotation random_rotation(std::mt19937_64& random);

// Adds the node, element and particle columns that the materials and formulation need. Requires Bodies::slots.
void add_body_columns(World& world, const Scene& scene, const Bodies& bodies, const Shapes& shapes);

// Positions and velocities. `placed`: by slot; in empty slots the mesh rests at the origin.
void fill_bodies(World& world, const std::vector<std::optional<Placed>>& placed,
                 const Bodies& bodies, const Shapes& shapes);

void fill_materials(World& world, const Scene& scene, const Bodies& bodies);

}  // namespace pulvis::space
