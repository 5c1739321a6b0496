// The deformable bodies of a world in three dimensions: tables and columns, and what stands in them at the start.
#pragma once

#include <optional>
#include <random>
#include <vector>

#include "components/shape.hpp"
#include "components/space/shape.hpp"
#include "engine/world.hpp"
#include "scenes/spec/space_scene.hpp"

namespace pulvis::space {

// One particle in its lane.
struct Placed {
  const BodySpec* body = nullptr;
  Rotation turn = Rotation::Identity();  // from the frame of its mesh to the scene's
};

// Uniform over all rotations (Shoemake 1992), the same on every machine.
Rotation random_rotation(std::mt19937_64& random);

// Adds what the scene's materials and formulation need of nodes, elements and particles. Bodies::slots are known.
void add_body_columns(World& world, const Scene& scene, const Bodies& bodies, const Shapes& shapes);

// Positions and velocities. `placed`: by slot; where nobody stands the mesh rests at the origin.
void fill_bodies(World& world, const std::vector<std::optional<Placed>>& placed,
                 const Bodies& bodies, const Shapes& shapes);

void fill_materials(World& world, const Scene& scene, const Bodies& bodies);

}  // namespace pulvis::space
