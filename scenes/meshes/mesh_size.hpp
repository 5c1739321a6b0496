// Meshes of a given edge length, and how many edges an outline needs.
#pragma once

#include "scenes/spec/scene.hpp"

namespace pulvis {

// Sets the counts of the particle's mesh from its mesh_size: enough rings for their quads to be about as
// thick as the edges are long, at least one. Counts may exceed what a mesh may have.
void mesh_of_size(ParticleSpec& particle);

// The smallest number of boundary edges that a mesh of the outline may have, a multiple of 4.
int fewest_boundary_edges(const Outline& outline);

}  // namespace pulvis
