// The solid's response to small forces, at rest.
//
// Factorising the stiffness loses about 1e-16 (L/t)^4 of a lever's bending: the matrix entries are
// those of its membrane stiffness. Forces that the elements compute from displacements lose far less
// (systems/lever/solid_kernel.hpp), so the solution is corrected by the residual forces: iterative refinement.
#pragma once

#include <span>
#include <vector>

#include "engine/world.hpp"
#include "systems/lever/static_solver.hpp"

namespace pulvis {

struct LinearResponse {
  std::vector<double> displacements;  // [3 nodes] m
  std::vector<double>
      forces;  // [3 nodes] N, internal forces of the elements; for fixed nodes, the reactions
  // Estimates of its error: the last correction over the displacements, and how far the work of the
  // forces differs from twice the elements' energy.
  double correction = 0, energy_error = 0;  // -
  int corrections = 0;
};

// Due to forces [3 nodes]. The solver must have been linearised at rest; the world's displacements are used and
// reset to rest.
LinearResponse linear_response(World& world, StaticSolver& solver, std::span<const double> forces);

}  // namespace pulvis
