// From packings and bodies to single particles.
#pragma once

#include "scenes/spec/scene.hpp"

#include <vector>

namespace pulvis {

// Overlaps up to this share of the smaller particle's size are round-off: particles that touch
// exactly, as in a square packing, are meant to.
inline constexpr double touching_tolerance = 1e-9;

// Rows count from the bottom, from 0.
int particles_in_row(const PackingSpec& packing, int row);
std::int64_t particle_count(const PackingSpec& packing);
bool is_lattice(const PackingSpec& packing);  // not random, not from a file

// m, where a punch rests on a lattice: on the upper side of its highest cells; on the highest packing.
double top_of_lattice(const PackingSpec& packing);
double top_of_packings(const Scene& scene);

// Every particle of the scene. Bodies and packings come in the order of the file, a packing row by
// row from the bottom, each row from the left, random and CSV packings as they were filled; the position in the list is the particle's number.
std::vector<BodySpec> place_bodies(const Scene& scene);

}  // namespace pulvis
