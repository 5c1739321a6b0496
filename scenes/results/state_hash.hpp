// One number for the state of a run: two runs with the same hash agree in every bit of the state that the
// next step starts from. It distinguishes a change of speed from a change of physics.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "engine/world.hpp"
#include "scenes/results/mesh_values.hpp"

namespace pulvis {

// XXH3 over the clock; over positions, velocities and plastic state, particle by particle in the order of
// the scene; and over the edges in contact, with their elastic slip, in the order of their particles'
// numbers. Chunks, lanes, threads and inactive contact rows do not affect it, nor do columns
// that a step recomputes from these.
// For a solid (AFM), which has no clock: over the displacements, loads and plastic state at the start of an
// increment, the forces and history of the probe's points, and the resources in a checkpoint.
std::uint64_t state_hash(const World& world);
// What the hash covers of every particle, in this order: first state_values, then the history of its contacts.
std::vector<ParticleValues> hashed_values();
// `visit` supplies the values of number `hashed` of all particles by number, where `world` does not hold them.
using VisitHashed = std::function<void(std::size_t hashed, const ValueSink& take)>;
std::uint64_t state_hash(const World& world, const VisitHashed& visit);

// As written to files: 16 hexadecimal digits.
std::string state_hash_text(std::uint64_t hash);
std::string state_hash_text(const World& world);

}  // namespace pulvis
