// Individual particles from packings and bodies.
#pragma once

#include "scenes/spec/scene.hpp"

#include <vector>

namespace pulvis {

// Overlaps up to this fraction of the smaller particle's size are round-off: particles may touch
// exactly on purpose, as in a square packing.
inline constexpr double touching_tolerance = 1e-9;

// Rows are numbered from the bottom, from 0.
int particles_in_row(const PackingSpec& packing, int row);
std::int64_t particle_count(const PackingSpec& packing);
bool is_lattice(const PackingSpec& packing);  // not random, not from a file

// m, where a punch rests on a lattice: top of its highest cells; on the highest packing.
double top_of_lattice(const PackingSpec& packing);
double top_of_packings(const Scene& scene);

// Every particle of the scene. Bodies and packings are in file order; a packing row by
// row from the bottom, each row from the left; random and CSV packings as they were filled. The position in the list is the particle's number.
std::vector<BodySpec> place_bodies(const Scene& scene);

}  // namespace pulvis
