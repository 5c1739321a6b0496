// One number for the state of a run: two runs with the same hash agree in every bit of what the next step
// starts from. It tells a change of speed from a change of physics.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "engine/world.hpp"
#include "scenes/results/mesh_values.hpp"

namespace pulvis {

// XXH3 over the clock; over positions, velocities and plastic state, particle by particle in the order of
// the scene; and over the edges that touch, with their elastic slip, in the order of their particles'
// numbers. Chunks, lanes, threads and contact rows that do not touch have no part in it, nor have columns
// that a step makes anew from these.
// Of a solid (AFM), which has no clock: over the displacements, loads and plastic state that an increment begins
// with, the forces and memory of the probe's points, and the resources that a checkpoint keeps.
std::uint64_t state_hash(const World& world);
// `visit` takes state_values of all particles by number, where `world` does not hold them.
using VisitState = std::function<void(const ValueSink& take)>;
std::uint64_t state_hash(const World& world, const VisitState& visit);

// As files write it: 16 hexadecimal digits.
std::string state_hash_text(std::uint64_t hash);
std::string state_hash_text(const World& world);

}  // namespace pulvis
