// The solid's answer to small forces, at rest.
//
// The factors of the stiffness lose about 1e-16 (L/t)^4 of a lever's bending: the numbers of the matrix are
// those of its membrane. Forces that the elements find from displacements lose far less
// (systems/lever/solid_kernel.hpp), so the answer is corrected by what they leave unbalanced: iterative refinement.
#pragma once

#include <span>
#include <vector>

#include "engine/world.hpp"
#include "systems/lever/static_solver.hpp"

namespace pulvis {

struct LinearResponse {
  std::vector<double> displacements;  // [3 nodes] m
  std::vector<double>
      forces;  // [3 nodes] N, what holds the elements: of held nodes, their holder's
  // What is known of its error: the last correction over the displacements, and by how much the work of the
  // forces is not twice the elements' energy.
  double correction = 0, energy_error = 0;  // -
  int corrections = 0;
};

// To forces [3 nodes]. The solver must have been linearised at rest; the world's displacements are used and
// left at rest.
LinearResponse linear_response(World& world, StaticSolver& solver, std::span<const double> forces);

}  // namespace pulvis
