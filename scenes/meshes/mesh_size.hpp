// Meshes of a wanted edge length, and how many edges an outline needs.
#pragma once

#include "scenes/spec/scene.hpp"

namespace pulvis {

// The counts of the particle's mesh from its mesh_size: as many rings as keep their quads about as thick as
// the edges are long, at least one. Counts may come out beyond what a mesh may have.
void mesh_of_size(ParticleSpec& particle);

// The fewest boundary edges that a mesh of the outline may have, a multiple of 4.
int fewest_boundary_edges(const Outline& outline);

}  // namespace pulvis
