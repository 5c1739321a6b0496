// Individual particles from packings and bodies, in both dimensions.
//
// Rows in the plane stand in their square cells. Lattices in space stand between flat walls as a whole: the outermost
// particles are half a neighbour distance t from the corner.
//   cubic         t = spacing, one particle in each cell
//   body-centred  t = sqrt(3)/2 spacing, two: (0,0,0) and (1,1,1)/2 of a cell
//   face-centred  t = spacing/sqrt(2), four: (0,0,0), (1,1,0)/2, (1,0,1)/2, (0,1,1)/2
//   hexagonal     t = spacing: rows along x, sqrt(3)/2 apart, every second one shifted by half of it; layers sqrt(2/3)
//                 apart, every second one shifted into the hollows (ABAB)
#pragma once

#include "scenes/spec/scene.hpp"

#include <vector>

namespace pulvis {

// Overlaps up to this fraction of the smaller particle's size are round-off: particles may touch
// exactly on purpose, as in a square packing.
inline constexpr double touching_tolerance = 1e-9;

// Of a lattice in the plane: rows are numbered from the bottom, from 0.
int particles_in_row(const PackingSpec& packing, int row);
std::int64_t particle_count(const PackingSpec& packing);
bool is_lattice(const PackingSpec& packing);  // not random, not from a file

// Relative to the diameter of touching spheres or discs.
double touching_spacing(PackingSpec::Kind kind);
// m, of a lattice between flat walls; in the plane along x and y.
Vec3 size_of_lattice(const PackingSpec& packing);
// m, where a punch rests on a lattice: top of its highest cells; on the highest packing.
double top_of_lattice(const PackingSpec& packing);
double top_of_packings(const Scene& scene);

// Every particle of the scene. Bodies and packings are in file order; a lattice along x, then y, then z, cell by cell;
// random and CSV packings as they were filled. The position in the list is the particle's number.
std::vector<BodySpec> place_bodies(const Scene& scene);

}  // namespace pulvis
